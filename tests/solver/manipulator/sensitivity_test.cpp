// ctest: timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/manipulator/sensitivity_map.h"
#include "tests/support/solver/sensitivity_designs.h"

BOOST_AUTO_TEST_SUITE(sensitivity)

using namespace trammel::solver;
using boost::test_tools::tolerance;
using Eigen::VectorXd;

BOOST_AUTO_TEST_CASE(derivatives_of_single_links_add_up) {
  std::vector<DesignParameter> parameters = {all(Kind::length)};
  for (std::size_t limb = 0; limb < 3; ++limb) {
    parameters.push_back(length_parameter(limb, true));
    parameters.push_back(length_parameter(limb, false));
  }
  const FrequencySensitivity s =
      frequency_sensitivity(coarse_design(), {0.27, 0.13, 0.05}, parameters, 6);
  BOOST_TEST(s.counters.factorizations > 0);
  for (Index n = 0; n < 6; ++n) {
    BOOST_TEST(s.sets[static_cast<std::size_t>(n)].count == 1);
    const double together = s.derivative(n, 0);
    BOOST_TEST(std::abs(s.derivative.row(n).tail(6).sum() - together) <
               1e-9 * s.derivative.row(n).cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(limbs_have_equal_derivatives_in_a_symmetric_pose) {
  // The threefold symmetry causes pairs of equal frequencies. The eigensolver returns an arbitrary
  // basis of the two mode shapes.
  for (const double phi : {0.0, 0.3}) {
    std::vector<DesignParameter> parameters;
    for (std::size_t limb = 0; limb < 3; ++limb) parameters.push_back(length_parameter(limb, true));
    parameters.push_back(all(Kind::length));
    const FrequencySensitivity s =
        frequency_sensitivity(coarse_design(), centered_pose(phi), parameters, 6);
    BOOST_TEST_REQUIRE(s.outcome.solved());
    bool pair = false;
    for (const FrequencySet& set : s.sets) {
      const double f = s.frequency[set.first];
      const double below = set.first > 0 ? f - s.frequency[set.first - 1] : s.frequency.maxCoeff();
      BOOST_TEST(s.gap[set.first] > 0);
      BOOST_TEST(s.gap[set.first] * f < below * (1 + 1e-12));
      if (set.count != 2) continue;
      pair = true;
      const double size = s.derivative.middleRows(set.first, 2).cwiseAbs().maxCoeff();
      for (Index n = set.first; n < set.first + 2; ++n) {
        BOOST_TEST(std::abs(s.derivative(n, 0) - s.derivative(n, 1)) < 1e-8 * size);
        BOOST_TEST(std::abs(s.derivative(n, 0) - s.derivative(n, 2)) < 1e-8 * size);
      }
      // A change of one limb separates a pair of frequencies, but a change of all limbs does not.
      BOOST_TEST(s.derivative(set.first + 1, 0) - s.derivative(set.first, 0) > 0.01 * size);
      BOOST_TEST(std::abs(s.derivative(set.first + 1, 3) - s.derivative(set.first, 3)) <
                 1e-8 * size);
    }
    BOOST_TEST(pair);
    BOOST_TEST(s.derivative.allFinite());
  }
}

BOOST_AUTO_TEST_CASE(incomplete_frequency_set_keeps_lowest_derivative) {
  const ManipulatorDesign design = coarse_design();
  const DesignParameter parameter = length_parameter(0, true);
  const FrequencySensitivity all_six =
      frequency_sensitivity(design, centered_pose(), {parameter}, 6);
  for (const FrequencySet& set : all_six.sets) {
    if (set.count < 2) continue;
    const FrequencySensitivity cut =
        frequency_sensitivity(design, centered_pose(), {parameter}, set.first + 1);
    const double size = all_six.derivative.cwiseAbs().maxCoeff();
    BOOST_TEST(std::abs(cut.derivative(set.first, 0) - all_six.derivative(set.first, 0)) <
               1e-8 * size);
  }
}

BOOST_AUTO_TEST_CASE(modes_lost_to_round_off_do_not_crash) {
  // With free actuators near a folded limb, the eigensolver returns eigenvalues without vectors.
  // The missing vectors were once read out of bounds.
  ManipulatorDesign design = coarse_design();
  design.platform.kind = PlatformKind::rigid;
  design.active.fill({ActiveKind::free});
  const PoseGrid grid = reachable_grid(design.geometry, std::acos(-1.0) / 6, 41);
  const Pose pose{grid.x0 + 11 * grid.dx, grid.y0 + 30 * grid.dy, grid.phi};
  const FirstFrequency first = first_frequency(design, all(Kind::length), pose);
  BOOST_TEST(first.outcome.solved() == std::isfinite(first.frequency));
}

BOOST_AUTO_TEST_CASE(sensitivity_map_covers_reach_and_equals_single_poses) {
  const ManipulatorDesign design = coarse_design(1);
  const PoseGrid grid = reachable_grid(design.geometry, 0.1, 15);
  const SensitivityMap map = map_first_frequency(design, all(Kind::length), grid);
  BOOST_TEST(map.frequency.rows() == grid.rows);
  Index reachable = 0;
  for (Index j = 0; j < grid.rows; ++j)
    for (Index i = 0; i < grid.columns; ++i) {
      const Pose pose{grid.x0 + static_cast<double>(i) * grid.dx,
                      grid.y0 + static_cast<double>(j) * grid.dy, grid.phi};
      const bool inside = inverse_kinematics(design.geometry, pose).outcome.solved();
      BOOST_TEST(std::isfinite(map.frequency(j, i)) == inside);
      reachable += inside ? 1 : 0;
      if (!inside || (i + j) % 5 != 0) continue;
      const FrequencySensitivity s = frequency_sensitivity(design, pose, {all(Kind::length)}, 1);
      BOOST_TEST(map.frequency(j, i) == s.frequency[0]);
      BOOST_TEST(map.derivative(j, i) == s.derivative(0, 0));
    }
  BOOST_TEST(reachable > grid.rows * grid.columns / 4);
}

BOOST_AUTO_TEST_CASE(workspace_boundary_has_a_singular_limb) {
  ManipulatorGeometry geometry = coarse_design().geometry;
  geometry.distal = {0.15, 0.2, 0.18};
  std::size_t all = 0, points = 0;
  for (const Polyline& arc : workspace_boundary(geometry, 0.2, 360)) {
    all += arc.size();
    for (const Vector2d& P : arc) {
      const Vector2d inward = 1e-9 * (Vector2d(0.25, 0.144) - P).normalized();
      bool found = false;  // true: a pose next to the arc is nearly singular
      for (const double side : {1.0, -1.0}) {
        const Pose pose{P.x() + side * inward.x(), P.y() + side * inward.y(), 0.2};
        const Posture posture = inverse_kinematics(geometry, pose);
        if (!posture.outcome.solved()) continue;
        found = found || jacobians(geometry, pose, posture).serial_distance < 1e-3;
      }
      points += found ? 0 : 1;
    }
  }
  BOOST_TEST(all > 180U);  // 180 points are half a circle
  BOOST_TEST(points == 0U);
}

BOOST_AUTO_TEST_CASE(parallel_determinant_is_zero_on_singular_curves) {
  const ManipulatorGeometry geometry = coarse_design().geometry;
  const PoseGrid grid = reachable_grid(geometry, 0.1, 81);
  const std::vector<Polyline> curve = parallel_singularities(geometry, grid);
  BOOST_TEST(curve.size() > 20U);
  for (const Polyline& segment : curve)
    for (const Vector2d& P : segment) {
      const Pose pose{P.x(), P.y(), 0.1};
      const Posture posture = inverse_kinematics(geometry, pose);
      BOOST_TEST_REQUIRE(posture.outcome.solved());
      BOOST_TEST(jacobians(geometry, pose, posture).parallel_distance < 1e-9);
    }
}

BOOST_AUTO_TEST_SUITE_END()
