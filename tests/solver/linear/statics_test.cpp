#include "solver/linear/statics.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "solver/linear/second_order.h"
#include "solver/model/numbers.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(statics)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// Returns the displacement of the joint of two hinged bars, EA = 1, under a unit force along y.
/// The displacement is computed in extended precision from the rounded positions of the nodes.
Vector2d joint_of_a_toggle(const Model& model) {
  std::array<std::array<long double, 2>, 2> n{};
  std::array<long double, 2> L{};
  for (std::size_t i = 0; i < 2; ++i) {
    for (Index k = 0; k < 2; ++k) {
      n[i][to_size(k)] = static_cast<long double>(model.nodes[2].position[k]) -
                         static_cast<long double>(model.nodes[i].position[k]);
    }
    L[i] = std::hypot(n[i][0], n[i][1]);
    for (long double& component : n[i]) component /= L[i];
  }
  const long double det = n[0][0] * n[1][1] - n[0][1] * n[1][0];
  const long double e0 = -n[1][0] / det * L[0], e1 = n[0][0] / det * L[1];  // elongations N L / EA
  return {static_cast<double>((e0 * n[1][1] - e1 * n[0][1]) / det),
          static_cast<double>((e1 * n[0][0] - e0 * n[1][0]) / det)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(displacement_error_of_nan_is_not_solved) {
  BOOST_TEST(outcome_by_displacement_error(0.09).solved());
  BOOST_TEST(!outcome_by_displacement_error(0.11).solved());
  BOOST_TEST(!outcome_by_displacement_error(std::nan("")).solved());
}

BOOST_AUTO_TEST_CASE(load_on_a_clamped_node_is_its_reaction) {
  Model model = beam(unit_section(), 1, 1);
  model.supports = {clamp(0), clamp(1)};
  model.loads = {{1, {1, 2, 3}}};
  const StaticSolution r = solve_statics(assemble(model));
  BOOST_TEST(r.outcome.solved());
  BOOST_TEST((r.reaction.row(1) + Eigen::RowVector3d(1, 2, 3)).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(ill_conditioned_model_is_exact_or_refused) {
  for (const Index elements : {3000, 10000, 30000}) {  // condition numbers from 1e15 to 1e19
    Model model = cantilever(unit_section(100), 1, elements);
    model.loads = {{1, {0, 1, 0}}};
    const StaticSolution r = solve_statics(assemble(model));
    if (r.outcome.solved()) {
      BOOST_TEST(r.displacement(1, 1) == 1 / 3.0, tolerance(1e-6));
    } else {
      BOOST_TEST((r.outcome.status == Status::not_converged));
      BOOST_TEST(r.displacement.size() == 0);
    }
  }
}

BOOST_AUTO_TEST_CASE(digits_next_to_a_singularity_are_kept_and_reported) {
  // Two nearly collinear hinged bars meet at a joint of small height. The error estimate was once
  // proportional to the condition number of K, 1/height^2, so that heights below 1e-7 were refused.
  // The displacement has a relative error of only eps/height.
  std::vector<double> beyond;  // correct digits minus estimated correct digits
  for (int power = 1; power <= 12; ++power) {
    const double height = std::pow(10.0, -power);
    Model model;
    for (const Vector2d& p : {Vector2d(-1, 0), Vector2d(1.3, 0), Vector2d(0, height)})
      model.nodes.push_back({"", Eigen::Rotation2Dd(0.5) * p});
    model.members = {hinged("a", 0, 2, unit_section(1)), hinged("b", 1, 2, unit_section(1))};
    model.supports = {pin(0), pin(1)};
    model.loads = {{2, {0, 1, 0}}};
    const StaticSolution r = solve_statics(assemble(model));
    BOOST_TEST_REQUIRE(r.outcome.solved(), height << ": " << r.outcome.reason);
    const Vector2d exact = joint_of_a_toggle(model);
    const Vector2d found = r.displacement.row(2).head<2>();
    const double error = (found - exact).norm() / exact.norm();
    beyond.push_back(-std::log10(std::max(error, kEps)) - r.estimated_correct_digits);
    BOOST_TEST(beyond.back() > -0.3, height);
    BOOST_TEST(beyond.back() < 3, height);
  }
  std::sort(beyond.begin(), beyond.end());
  BOOST_TEST(beyond[beyond.size() / 2] < 2);
}

BOOST_AUTO_TEST_SUITE_END()
