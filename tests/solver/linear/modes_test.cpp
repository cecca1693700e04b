#include "solver/linear/modes.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/row_balance.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(modes)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kCantilever[] = {1.87510406871196117, 4.69409113297417458, 7.85475743823761256,
                                  10.995540734875467};
const auto kPaths = {EigenMethod::dense, EigenMethod::sparse};

ModalSolution solve(const Model& model, Index count, EigenMethod path = EigenMethod::automatic) {
  return solve_modes(assemble(model), {count, path});
}

}  // namespace

BOOST_AUTO_TEST_CASE(round_off_estimate_bounds_the_frequency_error) {
  for (const Index elements : {256, 512, 1024}) {
    const ModalSolution m = solve(cantilever(unit_section(1e7), 1, elements, 0.3), 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const double bh = kCantilever[k] / static_cast<double>(elements);
      const double exact =
          kCantilever[k] * kCantilever[k] / (2 * kPi) * (1 + std::pow(bh, 4) / 1440);
      const double off = std::abs(m.frequency[static_cast<Index>(k)] / exact - 1);
      BOOST_TEST(off < 10 * m.roundoff[static_cast<Index>(k)] + std::pow(bh, 6));
    }
  }
}

BOOST_AUTO_TEST_CASE(dense_and_sparse_methods_agree_on_repeated_modes) {
  const System system = assemble(pinned_double_cross(8));
  const ModalSolution all = solve_modes(system, {16, EigenMethod::dense});
  for (const EigenMethod path : kPaths)
    for (const Index count : {1, 4, 6, 13, 16}) {  // 4, 6 and 13 split equal frequencies
      const ModalSolution m = solve_modes(system, {count, path});
      BOOST_REQUIRE(m.outcome.solved());
      BOOST_REQUIRE(m.frequency.size() == count);
      const MatrixXd gram = m.shape.transpose() * system.M * m.shape;
      BOOST_TEST((gram - MatrixXd::Identity(count, count)).cwiseAbs().maxCoeff() < 1e-12);
      for (Index i = 0; i < count; ++i) {
        BOOST_TEST(m.frequency[i] == all.frequency[i], tolerance(1e-11));
        const VectorXd x = m.shape.col(i);
        const double w2 = std::pow(2 * kPi * m.frequency[i], 2);
        BOOST_TEST((system.K * x - w2 * (system.M * x)).norm() < 1e-10 * (system.K * x).norm());
      }
      const ModalSolution again = solve_modes(system, {count, path});
      BOOST_TEST((again.shape.array() == m.shape.array()).all());
    }
}

BOOST_AUTO_TEST_CASE(all_rigid_modes_are_counted_if_fewer_are_requested) {
  const Model model = beam(unit_section(1e7), 1, 8);
  for (const EigenMethod path : kPaths)
    for (const Index count : {1, 3}) {
      const ModalSolution m = solve(model, count, path);
      BOOST_REQUIRE(m.outcome.solved());
      BOOST_TEST(m.frequency.size() == count);
      BOOST_TEST(m.frequency.isZero(0));
      BOOST_TEST(m.zero_energy_mode_count == 3);
    }
}

/// Free body on a massless beam. The three rigid motions have the full mass of the model.
BOOST_AUTO_TEST_CASE(model_with_only_rigid_modes_has_no_vibration) {
  Section section = unit_section();
  section.mass_per_length = 0;
  for (const Index elements : {2, 16, 64}) {
    Model model = beam(section, 1, elements);
    model.masses = {{1, 2, 0.5, {0, 0}}};
    for (const EigenMethod path : kPaths) {
      const ModalSolution m = solve(model, 6, path);
      BOOST_TEST(m.outcome.solved(), m.outcome.reason);
      BOOST_TEST(m.zero_energy_mode_count == 3);
      BOOST_TEST(m.frequency.size() == 3);
      BOOST_TEST(m.frequency.isZero(0));
    }
  }
}

BOOST_AUTO_TEST_CASE(too_many_requested_modes_return_all_modes) {
  const Model model = cantilever(unit_section(), 1, 1);
  for (const EigenMethod path : kPaths) {
    const ModalSolution m = solve(model, 50, path);
    BOOST_TEST(m.outcome.solved(), m.outcome.reason);
    BOOST_TEST(m.frequency.size() == 3);
  }
}

BOOST_AUTO_TEST_CASE(backward_error_of_modes_finds_a_wrong_mode) {
  const System system = assemble(build_manipulator(table_1_design(), centered_pose()));
  const ModalSolution modes = solve_modes(system, {4});
  VectorXd w2 = (2 * kPi * modes.frequency).cwiseAbs2();
  const auto error_of = [&](Index first, Index count) {
    const Eigen::MatrixXd u = system.T * modes.shape.middleCols(first, count);
    RowBalance<double> rows(system, count);
    rows.add_elastic_forces(u);
    rows.add_inertia_forces(u * (-w2.segment(first, count)).asDiagonal());
    return rows.backward_error();
  };
  double largest = 0;
  for (Index mode = 0; mode < 4; ++mode) largest = std::max(largest, error_of(mode, 1));
  BOOST_TEST(largest < 1e-12);
  BOOST_TEST(error_of(0, 4) == largest);
  for (Index wrong = 0; wrong < 4; ++wrong) {
    const double right = w2[wrong];
    w2[wrong] *= 1 + 1e-3;
    BOOST_TEST(error_of(0, 4) > 1e-9);
    w2[wrong] = right;
  }
}

BOOST_AUTO_TEST_SUITE_END()
