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

/// Returns two beams at a right angle, clamped at both far ends and loaded at their corner.
Model right_angle_frame(Index elements) {
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

BOOST_AUTO_TEST_CASE(statics_are_exact_in_reduced_coordinates) {
  const System full = assemble(right_angle_frame(8));
  const System reduced = reduce_members(full, 0);
  BOOST_TEST(reduced.K.rows() == 3);
  const StaticSolution a = solve_statics(full), b = solve_statics(reduced);
  BOOST_TEST((a.displacement - b.displacement).norm() < 1e-12 * a.displacement.norm());
}

BOOST_AUTO_TEST_CASE(reduced_frequencies_decrease_to_those_of_full_model) {
  const System full = assemble(right_angle_frame(16));
  const Eigen::VectorXd exact = frequencies(full, 4);
  double before = 1e300;
  for (const Index modes : {0, 1, 2, 4, 8}) {
    const System reduced = reduce_members(full, modes);
    BOOST_TEST(reduced.K.rows() == 3 + 2 * modes);
    const Eigen::VectorXd excess =
        (frequencies(reduced, 3) - exact.head(3)).cwiseQuotient(exact.head(3));
    BOOST_TEST(excess.minCoeff() > -1e-9);  // a reduced model is at least as stiff
    BOOST_TEST(excess.maxCoeff() < 0.7 * before);
    before = excess.maxCoeff();
  }
  BOOST_TEST(before < 1e-4);
}

BOOST_AUTO_TEST_CASE(reduction_with_all_member_modes_is_exact) {
  const System full = assemble(right_angle_frame(4));
  const System same = reduce_members(full, 9);
  BOOST_TEST(same.K.rows() == full.K.rows());
  BOOST_TEST((frequencies(same, 6) - frequencies(full, 6)).norm() < 1e-10);
  BOOST_CHECK_THROW((void)reduce_members(full, -1), ModelError);
}

BOOST_AUTO_TEST_CASE(modes_with_static_correction_are_exact_in_statics) {
  const System full = assemble(right_angle_frame(8));
  for (const Index count : {1, 3}) {
    const System reduced = reduce_to_modes(full, solve_modes(full, {.count = count}), {full.f});
    BOOST_TEST(reduced.K.rows() == count + 1);
    const StaticSolution a = solve_statics(full), b = solve_statics(reduced);
    BOOST_TEST((a.displacement - b.displacement).norm() < 1e-9 * a.displacement.norm());
  }
}

BOOST_AUTO_TEST_CASE(truncation_error_is_the_squared_frequency_ratio) {
  const System full = assemble(right_angle_frame(8));
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
    if (ratio > 0.1) BOOST_TEST(off > 1e-6);  // the reduction has an effect
  }
}

BOOST_AUTO_TEST_SUITE_END()
