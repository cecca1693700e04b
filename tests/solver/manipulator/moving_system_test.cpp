#include "solver/manipulator/moving_system.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/quadrature.h"
#include "solver/motion/modal_superposition.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(moving_system)

using namespace trammel::solver;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Returns a circular path with a rotating platform, so that every body moves.
Path circle_with_rotation() {
  std::vector<double> times;
  std::vector<Pose> poses;
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.02 * i;
    times.push_back(t);
    poses.push_back(
        {0.25 + 0.03 * std::cos(6 * t), 0.144 + 0.02 * std::sin(6 * t), 0.2 * std::sin(5 * t)});
  }
  return make_spline(times, poses, SplineEnds::natural);
}

std::vector<ManipulatorDesign> designs() {
  std::vector<ManipulatorDesign> all(4, meshed_design(2, PlatformKind::triangles));
  for (ManipulatorDesign& design : all)
    for (LinkDesign& link : design.distal) link.elements = 3;
  all[1].platform.kind = PlatformKind::rigid;
  all[1].platform_joint.fill({PlatformJointKind::welded});
  all[2].platform.kind = PlatformKind::rigid;  // P is not the mass center; inertias are given
  for (Vector2d& c : all[2].geometry.platform) c += Vector2d(0.01, -0.005);
  for (std::size_t i = 0; i < 3; ++i) {
    all[2].proximal[i].inertia = all[2].distal[i].inertia = 0.00078;
    all[2].distal[i].theory = BeamTheory::timoshenko;
    all[2].distal[i].thickness = 0.03;  // for a significant rotary inertia of the sections
  }
  all[2].active.fill({ActiveKind::sprung, 3});
  all[3].platform.kind = PlatformKind::rigid;
  for (std::size_t i = 0; i < 3; ++i)
    all[3].proximal[i].axially_flexible = all[3].distal[i].axially_flexible = false;
  return all;
}

/// System of a design that moves along a path.
struct Walk {
  ManipulatorDesign design;
  Path path;
  double start;
  MovingSystem moving;

  Walk(const ManipulatorDesign& d, const Path& p, double t, bool gyroscopic)
      : design(d),
        path(p),
        start(t),
        moving(build_manipulator(d, at(p, t).pose), {.gyroscopic = gyroscopic}) {}

  Outcome go_to(double time) {
    const RigidManipulator rigid = rigid_manipulator(design);
    const Vector9d from = inverse_dynamics(rigid, at(path, start)).q;
    const TrajectoryPoint point = at(path, time);
    return moving.move_to(nominal_motion(moving.start().model, inverse_dynamics(rigid, point), from,
                                         point, Vector2d(0.3, -9.81)));
  }
};

double difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

}  // namespace

BOOST_AUTO_TEST_CASE(moved_system_equals_a_newly_assembled_system) {
  for (const ManipulatorDesign& design : designs()) {
    Walk walk(design, circle_with_rotation(), 0.1, false);
    for (const double time : {0.1, 0.33, 0.7}) {
      BOOST_TEST_REQUIRE(walk.go_to(time).solved());
      Model model = build_manipulator(design, at(walk.path, time).pose);
      model.gravity = {0.3, -9.81};
      const System built = assemble(model);
      if (design.proximal[0].axially_flexible) {
        BOOST_TEST(difference(walk.moving.K(), built.K) < 1e-13);
        BOOST_TEST(difference(walk.moving.M(), built.M) < 1e-13);
        BOOST_TEST(difference(walk.moving.external_load(), built.f) < 1e-12);
        continue;
      }
      // The system moved to this pose and the system assembled at this pose may have eliminated
      // different coordinates. The test therefore compares eigenvalues instead of matrices.
      const VectorXd moved = all_modes(walk.moving.M(), walk.moving.K()).omega;
      const VectorXd there = all_modes(built.M, built.K).omega;
      BOOST_TEST((moved - there).cwiseQuotient(there).cwiseAbs().maxCoeff() < 1e-9);
    }
  }
}

BOOST_AUTO_TEST_CASE(load_of_inertia_is_that_of_equation_14) {
  // Eq. 14 of Varalakshmi and Srinivas (2017): a link with the angular velocity w, the angular
  // acceleration alpha and the acceleration a_A of its first node has the inertia load
  //
  //   F = T_s^T (w^2 H7^T - alpha H8^T - H9^T R^T a_A).
  //   H7 = int rho (x, 0) N, H8 = int rho (0, x) N, H9 = int rho N.
  //
  // N are the shape functions. T_s and R^T rotate from world axes to link axes.
  const double length = 0.2, angle = 0.7, w = 3, alpha = -11;
  const Vector2d a_A(0.8, -1.7);
  Model model;
  const Vector2d d(std::cos(angle), std::sin(angle));
  model.nodes = {{"A", {0, 0}}, {"B", length * d}};
  Member member;
  member.nodes = {0, 1};
  member.section = member.end_section = link_section(table_1_design().proximal[0], length);
  model.members = {member};
  MovingSystem moving(model);
  NominalMotion motion = moving.motion();
  motion.part[0] = {0, w, alpha};
  motion.node[2].row(0) = a_A;
  motion.node[2].row(1) = a_A + alpha * length * Vector2d(-d.y(), d.x()) - w * w * length * d;
  BOOST_TEST_REQUIRE(moving.move_to(motion).solved());

  Eigen::RowVectorXd H7 = Eigen::RowVectorXd::Zero(6);
  Eigen::RowVectorXd H8 = H7;
  Eigen::Matrix<double, 2, 6> H9 = Eigen::Matrix<double, 2, 6>::Zero();
  for (const LineQuadraturePoint& p : line_quadrature()) {
    const double rho = p.weight * length * member.section.mass_per_length;
    const Eigen::Matrix<double, 2, 6> N = frame_interpolation(0.0, length, p.xi).topRows<2>();
    H7 += rho * p.xi * length * N.row(0);
    H8 += rho * p.xi * length * N.row(1);
    H9 += rho * N;
  }
  const Matrix6d T = frame_transformation_matrix(d);
  const Vector6d F = T.transpose() * (w * w * H7.transpose() - alpha * H8.transpose() -
                                      H9.transpose() * (T.topLeftCorner<2, 2>() * a_A));
  BOOST_TEST((moving.inertia_load() - F).norm() < 1e-14 * F.norm());
}

BOOST_AUTO_TEST_CASE(nominal_inertia_carries_the_momentum_of_the_bodies) {
  // The sum of all nodal loads is - sum of m a over the bodies, by independent rigid dynamics.
  for (const ManipulatorDesign& design : designs()) {
    if (design.proximal[0].inertia) continue;
    Walk walk(design, circle_with_rotation(), 0.1, false);
    BOOST_TEST_REQUIRE(walk.go_to(0.4).solved());
    const RigidManipulator rigid = rigid_manipulator(design);
    const InverseDynamics dynamics = inverse_dynamics(rigid, at(walk.path, 0.4));
    Vector2d momentum = rigid.platform.mass * dynamics.bodies[6].acceleration;
    for (std::size_t i = 0; i < 3; ++i) {
      momentum += rigid.proximal[i].mass * dynamics.bodies[i].acceleration +
                  rigid.distal[i].mass * dynamics.bodies[3 + i].acceleration;
    }
    const VectorXd zero = VectorXd::Zero(walk.moving.K().rows());
    const VectorXd with = walk.moving.forces(zero, zero, zero, {}, true).external;
    const VectorXd without = walk.moving.forces(zero, zero, zero, {}, false).external;
    Vector2d sum = Vector2d::Zero();
    for (const auto& c : walk.moving.start().coordinates.node)
      sum += Vector2d(with[c[0]] - without[c[0]], with[c[1]] - without[c[1]]);
    BOOST_TEST((sum + momentum).norm() < 1e-12 * momentum.norm());
  }
}

BOOST_AUTO_TEST_CASE(common_displacement_has_no_gyroscopic_force) {
  Walk walk(table_1_design(), circle_with_rotation(), 0.1, true);
  BOOST_TEST_REQUIRE(walk.go_to(0.4).solved());
  const System& system = walk.moving.start();
  VectorXd u = VectorXd::Zero(system.coordinates.size);
  for (const auto& c : system.coordinates.node) u.segment<2>(c[0]) = Vector2d(0.3, -0.8);
  // A common translation of all nodes violates the constraints of the supports only. Elements
  // without a supported node are not affected.
  VectorXd q(walk.moving.K().rows());
  for (std::size_t i = 0; i < system.constraints.free.size(); ++i)
    if (system.constraints.free[i] >= 0) q[system.constraints.free[i]] = u[static_cast<Index>(i)];
  const VectorXd damping = walk.moving.gyroscopic_matrix() * q;
  const VectorXd stiffness = walk.moving.centrifugal_and_euler_matrix() * q;
  const double scale = walk.moving.gyroscopic_matrix().norm();
  for (std::size_t node = 6; node < 10; ++node) {  // nodes C1, C2, C3 and P, without supports
    for (std::size_t k = 0; k < 2; ++k) {
      const Index i =
          system.constraints.free[static_cast<std::size_t>(system.coordinates.node[node][k])];
      BOOST_TEST(std::abs(damping[i]) < 1e-13 * scale);
      BOOST_TEST(std::abs(stiffness[i]) < 1e-12 * scale);
    }
  }
}

BOOST_AUTO_TEST_CASE(nonzeros_of_inextensible_links_grow_linearly) {
  // The elimination of constraints once made each node depend on all previous nodes of its link.
  // The number of nonzeros of the stiffness matrix then increased quadratically.
  std::vector<double> entries;
  for (const Index elements : {8, 16}) {
    ManipulatorDesign design = meshed_design(elements);
    for (auto* links : {&design.proximal, &design.distal})
      for (LinkDesign& link : *links) link.axially_flexible = false;
    const Walk walk(design, circle_with_rotation(), 0.1, false);
    entries.push_back(static_cast<double>(walk.moving.K().nonZeros()));
  }
  BOOST_TEST(entries[1] / entries[0] < 2.1);
}

BOOST_AUTO_TEST_CASE(refused_pose_leaves_the_system_unchanged) {
  Walk walk(designs()[3], circle_with_rotation(), 0.1, false);
  MovingSystem& moving = walk.moving;
  const NominalMotion before = moving.motion();
  const VectorXd force = VectorXd::LinSpaced(moving.constraints().T.rows(), -1, 2);
  const VectorXd multipliers = moving.constraints().lagrange_multipliers(force);
  int refused = 0;
  for (std::size_t member = 0; member < moving.start().model.members.size(); ++member) {
    const auto& ends = moving.start().model.members[member].nodes;
    const Vector2d d = before.node[0].row(ends[1]) - before.node[0].row(ends[0]);
    // If the link is along x or y, the elimination has no pivot in the component across the link.
    for (const double along : {0.0, 0.5}) {
      NominalMotion motion = before;
      motion.part[member].angle = along * std::numbers::pi - std::atan2(d.y(), d.x());
      refused += moving.move_to(motion).solved() ? 0 : 1;
      BOOST_TEST_REQUIRE(moving.move_to(before).solved());
      BOOST_TEST((moving.constraints().lagrange_multipliers(force) - multipliers).norm() <
                 1e-10 * multipliers.norm());
    }
  }
  BOOST_TEST(refused > 0);
}

BOOST_AUTO_TEST_SUITE_END()
