// ctest: labels=manipulator
// Tests the assembled and solved manipulator: mass, limiting cases, symmetry, singular designs.
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(manipulator_mechanics)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;

ManipulatorDesign design_with_kind(PlatformDesign::Kind kind) {
  ManipulatorDesign design = table_1_design();
  design.platform.kind = kind;
  return design;
}

/// Pose in which the manipulator has no symmetry.
constexpr Pose kPose{0.26, 0.15, 0.1};
const Vector3d kForce{10, 4, 0};

StaticSolution solve(const ManipulatorDesign& design, const Pose& pose, const Vector3d& force) {
  Model model = build_manipulator(design, pose);
  model.loads.push_back({model.find_node("P"), force});
  return solve_statics(assemble(model));
}

/// Returns the displacement of P, which is node 9 (A1..A3, B1..B3, C1..C3, P).
Vector2d of_P(const StaticSolution& solution) {
  BOOST_TEST_REQUIRE(solution.outcome.solved(), solution.outcome.reason);
  return solution.displacement.row(9).head<2>().transpose();
}

ModalSolution modes(const ManipulatorDesign& design, const Pose& pose, Index count = 6) {
  return solve_modes(assemble(build_manipulator(design, pose)), {.count = count});
}

/// Returns the free coordinates of the velocity field (vx, vy, spin) of a model without supports.
Eigen::VectorXd rigid_motion(const System& system, const Vector3d& field) {
  Eigen::VectorXd q(system.constraints.free_count);
  Eigen::VectorXd u(system.coordinates.size);
  for (Index i = 0; i < u.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const auto node = static_cast<std::size_t>(system.coordinates.node_of[k]);
    const Vector2d& x = system.mesh.positions[node];
    if (system.coordinates.is_rotation[k]) {
      u(i) = field(2);
    } else if (system.coordinates.node[node][0] == i) {
      u(i) = field(0) - field(2) * x.y();
    } else {
      u(i) = field(1) + field(2) * x.x();
    }
    if (system.constraints.free[k] >= 0) q(system.constraints.free[k]) = u(i);
  }
  BOOST_TEST((system.T * q - u).norm() < 1e-12 * u.norm());  // the field satisfies every constraint
  return q;
}

System system_without_supports(const ManipulatorDesign& design) {
  Model model = build_manipulator(design, kPose);
  model.supports.clear();
  return assemble(model);
}

/// Returns manipulators with a rigid platform and each kind of platform joint, and with a platform
/// of triangles with and without pins.
std::vector<ManipulatorDesign> designs_with_all_platforms() {
  std::vector<ManipulatorDesign> designs;
  for (const PlatformJointKind kind : {PlatformJointKind::hinged, PlatformJointKind::welded,
                                       PlatformJointKind::sprung, PlatformJointKind::eq25_mean}) {
    ManipulatorDesign design = design_with_kind(PlatformDesign::Kind::rigid);
    design.platform_joint.fill({kind, 5});
    designs.push_back(design);
  }
  for (const double pin_radius : {0.0, 0.01}) {
    ManipulatorDesign design = design_with_kind(PlatformDesign::Kind::triangles);
    design.platform.refinements = 2;
    design.platform.pin_radius = pin_radius;
    designs.push_back(design);
  }
  return designs;
}

}  // namespace

BOOST_AUTO_TEST_CASE(assembled_mass_and_inertia_are_printed_or_by_density) {
  for (const ManipulatorDesign& by_density : designs_with_all_platforms()) {
    const Posture posture = inverse_kinematics(by_density.geometry, kPose);
    for (const bool printed : {false, true}) {
      ManipulatorDesign design = by_density;
      if (printed) {
        for (auto* links : {&design.proximal, &design.distal})
          for (LinkDesign& link : *links) link.mass = 0.0234, link.inertia = 0.00078;
        design.platform.mass = 0.1205;
      }
      const double link_mass = printed ? 0.0234 : 0.0243;
      const PlatformMass plate = platform_mass(design);
      BOOST_TEST(plate.mass == (printed ? 0.1205 : 2700 * 0.0015 * std::sqrt(0.75) * 0.02),
                 tolerance(1e-14));
      double inertia = plate.inertia + plate.mass * Vector2d(kPose.x, kPose.y).squaredNorm() +
                       (printed ? 6 * 0.00078 : 0.0);
      for (std::size_t i = 0; i < 3; ++i)
        for (const auto& [from, to] : {std::pair{design.geometry.base[i], posture.B[i]},
                                       std::pair{posture.B[i], posture.C[i]}})
          inertia += link_mass * ((from + to).squaredNorm() / 4 + (to - from).squaredNorm() / 12);
      const System system = system_without_supports(design);
      const auto twice_the_energy = [&](const Vector3d& field) {
        const Eigen::VectorXd q = rigid_motion(system, field);
        return q.dot(system.M * q);
      };
      BOOST_TEST(twice_the_energy({1, 0, 0}) == 6 * link_mass + plate.mass, tolerance(1e-12));
      BOOST_TEST(twice_the_energy({0, 1, 0}) == 6 * link_mass + plate.mass, tolerance(1e-12));
      BOOST_TEST(twice_the_energy({0, 0, 1}) == inertia, tolerance(1e-12));
      const auto massless = restrict_effects(design, Effects::all().without(Effect::link_mass));
      BOOST_TEST(!massless.proximal[0].inertia.has_value());
    }
  }
}

BOOST_AUTO_TEST_CASE(rigid_motions_store_no_energy) {
  for (const ManipulatorDesign& design : designs_with_all_platforms()) {
    const System system = system_without_supports(design);
    const double stiffness = Eigen::VectorXd(system.K.diagonal()).maxCoeff();
    for (const Vector3d& field : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)}) {
      const Eigen::VectorXd q = rigid_motion(system, field);
      BOOST_TEST((system.K * q).norm() < 1e-12 * stiffness * q.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(rigid_platform_is_the_limit_of_a_stiff_plate) {
  const Vector2d rigid = of_P(solve(design_with_kind(PlatformDesign::Kind::rigid), kPose, kForce));
  double last = 0;
  for (const double factor : {1.0, 10.0, 100.0, 1000.0}) {
    ManipulatorDesign design = design_with_kind(PlatformDesign::Kind::triangles);
    design.platform.material.E *= factor;
    const double difference = (of_P(solve(design, kPose, kForce)) - rigid).norm() / rigid.norm();
    if (last > 0) BOOST_TEST(last / difference == 10, tolerance(1e-2));  // proportional to 1/factor
    if (factor == 100) BOOST_TEST(difference < 1e-6);
    last = difference;
  }
}

BOOST_AUTO_TEST_CASE(platform_turns_by_mean_or_sum_of_equation_25) {
  for (const auto& [kind, share] : {std::pair{PlatformJointKind::eq25_mean, 1.0 / 3},
                                    std::pair{PlatformJointKind::eq25_sum, 1.0}}) {
    ManipulatorDesign design = design_with_kind(PlatformDesign::Kind::rigid);
    design.platform_joint.fill({kind});
    const StaticSolution s = solve(design, kPose, {10, 4, 0.3});
    BOOST_TEST_REQUIRE(s.outcome.solved());
    const double ends = s.end_rotation(1, 1) + s.end_rotation(3, 1) + s.end_rotation(5, 1);
    BOOST_TEST(std::abs(ends) > 1e-3);
    BOOST_TEST(std::abs(s.displacement(9, 2) - share * ends) < 1e-12 * std::abs(ends));
  }
}

BOOST_AUTO_TEST_CASE(clamps_carry_the_holding_torques) {
  for (const auto kind : {PlatformDesign::Kind::rigid, PlatformDesign::Kind::triangles}) {
    ManipulatorDesign design = design_with_kind(kind);
    design.elbow.fill({ElbowKind::hinged});
    const Posture posture = inverse_kinematics(design.geometry, kPose);
    const HoldingTorques hold = holding_torques(jacobians(design.geometry, kPose, posture), kForce);
    const StaticSolution s = solve(design, kPose, kForce);
    BOOST_TEST_REQUIRE(s.outcome.solved());
    for (Index i = 0; i < 3; ++i) {
      BOOST_TEST(std::abs(s.reaction(i, 2) - hold.torque(i)) < 1e-9 * hold.torque.norm());
      BOOST_TEST(std::abs(s.resultant_start(2 * i + 1, 0) - hold.tension(i)) <
                 1e-8 * hold.tension.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(pose_with_threefold_symmetry_repeats_frequencies) {
  for (const auto kind : {PlatformDesign::Kind::rigid, PlatformDesign::Kind::triangles})
    for (const double phi : {0.0, 0.3}) {
      const ModalSolution m = modes(design_with_kind(kind), centered_pose(phi), 9);
      BOOST_TEST_REQUIRE(m.outcome.solved(), m.outcome.reason);
      // Two of every three modes have equal frequencies, because displacements along x and y are
      // equivalent in the threefold symmetry.
      int pairs = 0;
      for (Index k = 0; k + 1 < m.frequency.size(); ++k) {
        const double gap = m.frequency(k + 1) / m.frequency(k) - 1;
        BOOST_TEST((gap < 1e-10 || gap > 1e-3), "gap " << gap << " above mode " << k);
        if (gap < 1e-10) ++pairs;
      }
      BOOST_TEST(pairs == 3);
    }
}

BOOST_AUTO_TEST_SUITE_END()
