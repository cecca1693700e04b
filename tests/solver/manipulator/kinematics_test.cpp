#include "solver/manipulator/kinematics.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "tests/support/solver/numerics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(kinematics)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;

constexpr double kPi = std::numbers::pi;

Vector3d as_vector(const std::array<double, 3>& a) {
  return {a[0], a[1], a[2]};
}

Pose moved(const Pose& pose, const Vector3d& direction, double s) {
  return {pose.x + s * direction(0), pose.y + s * direction(1), pose.phi + s * direction(2)};
}

}  // namespace

BOOST_AUTO_TEST_CASE(loops_close_to_round_off_around_the_circle) {
  for (const ManipulatorGeometry& g : {table_1_geometry(), uneven_geometry()})
    for (int k = 0; k < 631; ++k) {
      const double t = 0.01 * k;
      const Posture p =
          inverse_kinematics(g, {0.25 + 0.01 * std::cos(t), 0.144 + 0.01 * std::sin(t), 0.1});
      BOOST_TEST_REQUIRE(p.outcome.solved());
      // The closure error of a limb is of round-off size: coordinates of 0.8 m have rounding errors
      // of a few 1e-16 m.
      BOOST_TEST(p.closure_error < 1e-15);
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector2d tip =
            g.base[i] + g.proximal[i] * Vector2d(std::cos(p.active[i]), std::sin(p.active[i])) +
            g.distal[i] * Vector2d(std::cos(p.passive[i]), std::sin(p.passive[i]));
        BOOST_TEST((tip - p.C[i]).norm() < 1e-15);
      }
    }
}

BOOST_AUTO_TEST_CASE(working_mode_mirrors_the_elbow) {
  ManipulatorGeometry g = uneven_geometry();
  const Pose pose{0.27, 0.14, 0.2};
  const Posture p = inverse_kinematics(g, pose);
  for (int& mode : g.working_mode) mode = -mode;
  const Posture q = inverse_kinematics(g, pose);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d axis = (p.C[i] - g.base[i]).normalized();
    const Vector2d b = p.B[i] - g.base[i];
    const Vector2d mirrored = 2 * axis.dot(b) * axis - b;
    BOOST_TEST((q.B[i] - g.base[i] - mirrored).norm() < 1e-15);
    // If the elbow is on the clockwise side of the line from A to C, the distal link turns
    // counterclockwise from the proximal link (positive sine).
    BOOST_TEST(p.elbow_sine[i] == -q.elbow_sine[i]);
    BOOST_TEST((p.elbow_sine[i] > 0) == (g.working_mode[i] == 1));
    BOOST_TEST(std::abs(p.elbow_sine[i] - std::sin(p.passive[i] - p.active[i])) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(pose_out_of_reach_names_limb_and_distance) {
  const ManipulatorGeometry g = table_1_geometry();
  const Posture p = inverse_kinematics(g, {-0.2, 0.144, 0});
  BOOST_TEST((p.outcome.status == Status::singular));
  BOOST_TEST(p.outcome.reason.find("limb 2 (A2-B2-C2) cannot reach: C is 0.606") == 0U,
             p.outcome.reason);
  BOOST_TEST(p.outcome.reason.find("0.206") != std::string::npos, p.outcome.reason);
  BOOST_TEST(p.outcome.reason.find("limb 1") == std::string::npos);
  BOOST_TEST(std::isnan(p.active[1]));
  BOOST_TEST(std::isnan(p.closure_error));
  BOOST_TEST(std::isfinite(p.active[0]));

  ManipulatorGeometry stiff = g;
  stiff.proximal[0] = 0.5;
  BOOST_TEST(inverse_kinematics(stiff, {0.25, 0.144, 0})
                 .outcome.reason.find("within the difference of its link") != std::string::npos);
  BOOST_TEST(inverse_kinematics(g, {0.1, 0.1 / std::numbers::sqrt3, 0})
                 .outcome.reason.find("limb 1 (A1-B1-C1) has C at A") == 0U);
}

BOOST_AUTO_TEST_CASE(elbow_angle_keeps_its_digits_near_full_stretch) {
  // Limb 1 is along x, with links of length 1/2, and a distance h short of its full length. The
  // exact angle at A is 2 asin(sqrt(h / 2)), because its cosine is 1 - h. The acos of a rounded
  // cosine is inaccurate below h ~ 1e-9.
  ManipulatorGeometry g = table_1_geometry();
  g.base[0] = {0, 0};
  g.platform[0] = {0, 0};
  g.base[1] = {1, -0.25};
  g.base[2] = {1, 0.25};
  g.proximal[0] = g.distal[0] = 0.5;
  for (int k = 4; k < 50; ++k) {
    const double h = std::ldexp(1.0, -k);  // 1 - h is exact
    const Posture p = inverse_kinematics(g, {1 - h, 0, 0});
    BOOST_TEST_REQUIRE(!std::isnan(p.active[0]));
    const double exact = -2 * std::asin(std::sqrt(h / 2));
    BOOST_TEST(p.active[0] == exact, tolerance(1e-15));
    BOOST_TEST(p.elbow_sine[0] == std::sin(-2 * exact), tolerance(2e-15));
  }
}

BOOST_AUTO_TEST_CASE(jacobians_are_the_derivative_of_inverse_kinematics) {
  RandomStates random(7);
  for (const ManipulatorGeometry& g : {table_1_geometry(), uneven_geometry()})
    for (int trial = 0; trial < 50; ++trial) {
      const Pose pose = random.pose();
      const Vector3d rate = random.vector();
      const Posture p = inverse_kinematics(g, pose);
      BOOST_TEST_REQUIRE(p.outcome.solved());
      const Jacobians j = jacobians(g, pose, p);
      const Vector3d exact = (j.parallel * rate).cwiseQuotient(j.serial);
      const Vector3d difference = richardson(
          [&](double s) { return as_vector(inverse_kinematics(g, moved(pose, rate, s)).active); },
          4e-3);
      BOOST_TEST((exact - difference).norm() < 1e-8 * exact.norm());
    }
}

BOOST_AUTO_TEST_CASE(forward_kinematics_inverts_inverse_kinematics) {
  RandomStates random(8);
  const ManipulatorGeometry g = uneven_geometry();
  for (int trial = 0; trial < 50; ++trial) {
    const Pose pose = random.pose();
    const Posture p = inverse_kinematics(g, pose);
    const ForwardKinematics f = forward_kinematics(g, p.active, {0.26, 0.145, 0});
    BOOST_TEST_REQUIRE(f.outcome.solved(), f.outcome.reason);
    BOOST_TEST(std::hypot(f.pose.x - pose.x, f.pose.y - pose.y) < 1e-13);
    BOOST_TEST(std::abs(f.pose.phi - pose.phi) < 1e-12);
    BOOST_TEST(f.closure_error < 1e-15);
    BOOST_TEST(f.iterations < 10);
  }
}

BOOST_AUTO_TEST_CASE(elbows_too_far_apart_admit_no_assembly) {
  const ManipulatorGeometry g = table_1_geometry();
  const ForwardKinematics f =
      forward_kinematics(g, {-3 * kPi / 4, -kPi / 4, kPi / 2}, {0.25, 0.144, 0});
  BOOST_TEST(!f.outcome.solved());
  BOOST_TEST(!f.outcome.reason.empty());
}

BOOST_AUTO_TEST_CASE(holding_torques_do_the_opposite_work_of_the_load) {
  RandomStates random(9);
  for (const ManipulatorGeometry& g : {table_1_geometry(), uneven_geometry()})
    for (int trial = 0; trial < 50; ++trial) {
      const Pose pose = random.pose();
      const Posture p = inverse_kinematics(g, pose);
      const Jacobians j = jacobians(g, pose, p);
      const Vector3d wrench = random.vector().cwiseProduct(Vector3d(10, 10, 1));
      const HoldingTorques hold = holding_torques(j, wrench);
      BOOST_TEST_REQUIRE(hold.outcome.solved());
      const Vector3d dx = random.vector();
      const Vector3d dtheta = (j.parallel * dx).cwiseQuotient(j.serial);
      const double scale = wrench.norm() * dx.norm() / j.parallel_distance;
      BOOST_TEST(std::abs(hold.torque.dot(dtheta) + wrench.dot(dx)) < 1e-14 * scale);
      // The platform is in equilibrium under the load and the forces of the distal links, which act
      // at C_i along B_i - C_i.
      Vector3d sum = wrench;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vector2d e = (p.B[i] - p.C[i]).normalized() * hold.tension(static_cast<Index>(i));
        const Vector2d c = p.C[i] - Vector2d(pose.x, pose.y);
        sum += Vector3d(e.x(), e.y(), c.x() * e.y() - c.y() * e.x());
      }
      BOOST_TEST(sum.norm() < 1e-13 * wrench.norm() / j.parallel_distance);
    }
}

BOOST_AUTO_TEST_CASE(distal_links_through_one_point_hold_no_moment) {
  // The distal links are on the lines from C_i to P, so they resist no moment about P.
  ManipulatorGeometry g;
  const double thirds = 2 * kPi / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const double angle = thirds * static_cast<double>(i);
    const Vector2d out(std::cos(angle), std::sin(angle));
    const Vector2d side(-out.y(), out.x());
    g.platform[i] = 0.1 * out;
    g.base[i] = 0.3 * out + 0.2 * side;
  }
  g.proximal = {0.2, 0.2, 0.2};
  g.distal = {0.2, 0.2, 0.2};
  int radial_modes = 0;
  for (const int mode : {-1, 1}) {
    g.working_mode = {mode, mode, mode};
    const Pose pose;
    const Posture p = inverse_kinematics(g, pose);
    BOOST_TEST_REQUIRE(p.outcome.solved());
    const Jacobians j = jacobians(g, pose, p);
    const HoldingTorques hold = holding_torques(j, {0, 0, 1});
    const bool radial = std::abs(p.C[0].x() * (p.C[0] - p.B[0]).y()) < 1e-12;
    BOOST_TEST(hold.outcome.solved() == !radial);
    BOOST_TEST((j.parallel_distance < 1e-14) == radial);
    BOOST_TEST(hold.torque.hasNaN() == radial);
    radial_modes += radial ? 1 : 0;
  }
  BOOST_TEST(radial_modes == 1);
}

BOOST_AUTO_TEST_CASE(invalid_geometry_is_refused) {
  const double nan = std::nan("");
  const std::vector<std::function<void(ManipulatorGeometry&, Pose&)>> changes = {
      [](auto& g, auto&) { g.proximal[1] = 0; },
      [](auto& g, auto&) { g.distal[2] = -0.2; },
      [](auto& g, auto&) { g.distal[2] = std::numeric_limits<double>::infinity(); },
      [](auto& g, auto&) { g.working_mode[0] = 0; },
      [&](auto& g, auto&) { g.base[0].x() = nan; },
      [](auto& g, auto&) { g.platform.fill(Vector2d::Zero()); },
      [&](auto&, auto& pose) { pose.x = nan; }};
  for (const auto& change : changes) {
    ManipulatorGeometry geometry = table_1_geometry();
    Pose pose{0.25, 0.144, 0};
    change(geometry, pose);
    BOOST_CHECK_THROW((void)inverse_kinematics(geometry, pose), ModelError);
  }
}

BOOST_AUTO_TEST_SUITE_END()
