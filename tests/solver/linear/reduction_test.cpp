#include "solver/linear/reduction.h"

#include <boost/test/unit_test.hpp>

#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "solver/motion/harmonic.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(reduction)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Two beams at a right angle, clamped at both far ends, loaded at their corner.
Model angle(Index elements) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {1, 0}}, {"C", {1, 1.5}}};
  model.members = {member("AB", 0, 1, unit_section(), elements),
                   member("BC", 1, 2, unit_section(), elements)};
  model.supports = {clamp(0), clamp(2)};
  model.loads = {{1, {3, -2, 0.5}}};
  return model;
}

Eigen::VectorXd frequencies(const System& system, Index count) {
  const ModalSolution modes = solve_modes(system, {count, EigenMethod::dense});
  BOOST_TEST_REQUIRE(modes.outcome.solved(), modes.outcome.reason);
  return modes.frequency;
}

}  // namespace

BOOST_AUTO_TEST_CASE(statics_are_exact_in_the_reduced_coordinates) {
  const System full = assemble(angle(8));
  const System reduced = reduce_members(full, 0);
  BOOST_TEST(reduced.K.rows() == 3);
  const StaticSolution a = solve_statics(full), b = solve_statics(reduced);
  BOOST_TEST((a.displacement - b.displacement).norm() < 1e-12 * a.displacement.norm());
}

BOOST_AUTO_TEST_CASE(static_condensation_is_the_one_element_mesh) {
  // The static shape between the ends of a uniform beam is the cubic that one element has.
  const Eigen::VectorXd condensed = frequencies(reduce_members(assemble(angle(8)), 0), 3);
  const Eigen::VectorXd one = frequencies(assemble(angle(1)), 3);
  BOOST_TEST((condensed - one).norm() < 1e-4 * one.norm());
}

BOOST_AUTO_TEST_CASE(modes_of_the_insides_bring_the_frequencies_down_to_the_full_models) {
  const System full = assemble(angle(16));
  const Eigen::VectorXd exact = frequencies(full, 4);
  double before = 1e300;
  for (const Index modes : {0, 1, 2, 4, 8}) {
    const System reduced = reduce_members(full, modes);
    BOOST_TEST(reduced.K.rows() == 3 + 2 * modes);
    const Eigen::VectorXd excess =
        (frequencies(reduced, 3) - exact.head(3)).cwiseQuotient(exact.head(3));
    BOOST_TEST(excess.minCoeff() >
               -1e-9);  // a constrained model is not frequency_change_without_stiffness
    BOOST_TEST(excess.maxCoeff() < 0.7 * before);
    before = excess.maxCoeff();
  }
  BOOST_TEST(before < 1e-4);
}

BOOST_AUTO_TEST_CASE(with_all_modes_nothing_is_reduced) {
  const System full = assemble(angle(4));
  const System same = reduce_members(full, 9);
  BOOST_TEST(same.K.rows() == full.K.rows());
  BOOST_TEST((frequencies(same, 6) - frequencies(full, 6)).norm() < 1e-10);
  BOOST_CHECK_THROW((void)reduce_members(full, -1), ModelError);
}

BOOST_AUTO_TEST_CASE(modes_and_what_is_left_of_the_loads_give_statics_exactly) {
  const System full = assemble(angle(8));
  for (const Index count : {1, 3}) {
    const System reduced = reduce_to_modes(full, solve_modes(full, {.count = count}), {full.f});
    BOOST_TEST(reduced.K.rows() == count + 1);
    const StaticSolution a = solve_statics(full), b = solve_statics(reduced);
    BOOST_TEST((a.displacement - b.displacement).norm() < 1e-9 * a.displacement.norm());
  }
}

BOOST_AUTO_TEST_CASE(truncated_modes_miss_the_square_of_the_frequency_ratio_of_the_rest) {
  const System full = assemble(angle(8));
  const ModalSolution modes = solve_modes(full, {.count = 4});
  const System reduced = reduce_to_modes(full, solve_modes(full, {.count = 3}), {full.f});
  const auto answer = [](const System& system, double frequency) -> Eigen::VectorXcd {
    return system.T * HarmonicSolver(system, {{1e-3, 1e-4}, {}}).at(frequency);
  };
  for (const double ratio : {0.05, 0.2, 0.5}) {
    const double frequency = ratio * modes.frequency[3];
    const Eigen::VectorXcd whole = answer(full, frequency);
    const double off = (answer(reduced, frequency) - whole).norm() / whole.norm();
    BOOST_TEST(off < ratio * ratio / (1 - ratio * ratio));
    if (ratio > 0.1) BOOST_TEST(off > 1e-6);  // and they do miss it
  }
}

BOOST_AUTO_TEST_CASE(the_modes_of_a_model_that_moves_freely_are_corrected_as_well) {
  Model model = angle(8);
  model.supports = {};
  const System full = assemble(model);
  const ModalSolution modes = solve_modes(full, {.count = 6});
  const System reduced = reduce_to_modes(full, solve_modes(full, {.count = 5}), {full.f});
  BOOST_TEST(reduced.K.rows() == 6);
  const double frequency = 0.1 * modes.frequency[5];
  const auto answer = [frequency](const System& system) -> Eigen::VectorXcd {
    return system.T * HarmonicSolver(system, {{1e-3, 1e-5}, {}}).at(frequency);
  };
  BOOST_TEST((answer(reduced) - answer(full)).norm() < 0.011 * 0.1 * answer(full).norm());
}

BOOST_AUTO_TEST_CASE(the_work_of_the_reduction_is_counted) {
  const System full = assemble(angle(8));
  const System reduced = reduce_members(full, 2);
  BOOST_TEST(reduced.counters.element_evaluations == full.counters.element_evaluations);
  BOOST_TEST(reduced.counters.factorizations >= full.counters.factorizations + 2);
  BOOST_TEST(reduced.counters.solves > full.counters.solves);
}

BOOST_AUTO_TEST_SUITE_END()
