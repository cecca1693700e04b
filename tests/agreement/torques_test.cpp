// ctest: labels=verification;dynamics timeout=300
#include <boost/test/unit_test.hpp>
#include <iostream>
#include <random>

#include "references/manipulator/newton_euler.h"
#include "solver/manipulator/rigid_dynamics.h"

BOOST_AUTO_TEST_SUITE(torques)

namespace {

using namespace trammel;
using namespace trammel::solver;
using namespace trammel::references;

/// Limbs, masses and centres of mass all different, the platform's off P, gravity aslant.
RigidManipulator uneven() {
  RigidManipulator m;
  m.geometry.base = {Vector2d(0, 0), Vector2d(0.5, 0.02), Vector2d(0.22, 0.45)};
  m.geometry.platform = {Vector2d(-0.1, -0.06), Vector2d(0.11, -0.05), Vector2d(0.01, 0.12)};
  m.geometry.proximal = {0.2, 0.22, 0.21};
  m.geometry.distal = {0.21, 0.2, 0.23};
  m.geometry.working_mode = {-1, 1, -1};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(k);
    m.proximal[k] = {0.02 + 0.01 * i, 0.07 + 0.02 * i, 1e-4 + 3e-5 * i};
    m.distal[k] = {0.03 - 0.005 * i, 0.12 - 0.01 * i, 2e-4 - 4e-5 * i};
  }
  m.platform = {0.12, 7e-4, Vector2d(0.01, -0.02)};
  m.gravity = {1.5, -9.81};
  return m;
}

/// Table 1, masses from density.
RigidManipulator table_1() {
  RigidManipulator m;
  m.geometry.base = equilateral_base(0.5);
  m.geometry.platform = equilateral_platform(0.2);
  m.geometry.proximal = m.geometry.distal = {0.2, 0.2, 0.2};
  m.proximal.fill({0.0243, 0.1, 0.0243 * 0.04 / 12});
  m.distal = m.proximal;
  m.platform = {0.0701, 0.0701 * 0.04 / 12, Vector2d::Zero()};
  return m;
}

references::LinkNumbers body(const RigidLink& link, double length) {
  references::LinkNumbers numbers;
  numbers.length = length;
  numbers.mass = link.mass;
  numbers.center = link.center;
  numbers.inertia = link.inertia;
  return numbers;
}

references::ManipulatorNumbers bodies(const RigidManipulator& m) {
  references::ManipulatorNumbers result;
  for (std::size_t i = 0; i < 3; ++i) {
    references::LimbNumbers& limb = result.limbs[i];
    limb.base = {m.geometry.base[i].x(), m.geometry.base[i].y()};
    limb.corner = {m.geometry.platform[i].x(), m.geometry.platform[i].y()};
    limb.mode = m.geometry.working_mode[i];
    limb.proximal = body(m.proximal[i], m.geometry.proximal[i]);
    limb.distal = body(m.distal[i], m.geometry.distal[i]);
  }
  result.platform_mass = m.platform.mass;
  result.platform_inertia = m.platform.inertia;
  result.platform_center = {m.platform.center.x(), m.platform.center.y()};
  result.gravity = {m.gravity.x(), m.gravity.y()};
  return result;
}

/// Seeded states near the middle of the workspace, of the order of 1 m/s and 1 rad/s.
struct RandomState {
  TrajectoryPoint motion;
  Vector3d wrench;
  explicit RandomState(std::mt19937_64& engine) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Vector3d place;
    for (Vector3d* v : {&place, &motion.velocity, &motion.acceleration, &wrench}) {
      for (Index i = 0; i < 3; ++i) (*v)(i) = uniform(engine);
    }
    motion.pose = {0.26 + 0.03 * place(0), 0.145 + 0.03 * place(1), 0.25 * place(2)};
    motion.acceleration *= 3;
    wrench = wrench.cwiseProduct(Vector3d(10, 10, 1));
  }
  [[nodiscard]] std::array<references::Jet<references::Real>, 3> jets() const {
    const Vector3d x(motion.pose.x, motion.pose.y, motion.pose.phi);
    std::array<references::Jet<references::Real>, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto k = static_cast<Index>(i);
      result[i] = {x(k), motion.velocity(k), motion.acceleration(k)};
    }
    return result;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(ten_thousand_random_states_have_the_torques_of_newton_and_euler) {
  double worst = 0, symmetry = 0, skewness = 0, least = 1;
  std::mt19937_64 engine(2017);
  for (const RigidManipulator& m : {table_1(), uneven()}) {
    const references::ManipulatorNumbers independent = bodies(m);
    for (int trial = 0; trial < 5000; ++trial) {
      const RandomState state(engine);
      const InverseDynamics found = inverse_dynamics(m, state.motion, state.wrench);
      BOOST_TEST_REQUIRE(found.outcome.solved(), found.outcome.reason);
      const auto expected =
          references::newton_euler_forces(independent, state.jets(),
                                          {state.wrench(0), state.wrench(1), state.wrench(2)})
              .torque;
      Vector3d reference;
      for (Index i = 0; i < 3; ++i) {
        reference(i) = static_cast<double>(expected[static_cast<std::size_t>(i)]);
      }
      worst = std::max(worst, (found.torque - reference).norm() / reference.norm());
      const RigidTerms terms = rigid_terms(m, state.motion.pose, state.motion.velocity);
      const PropertyResiduals residuals = property_residuals(m, terms);
      symmetry = std::max(symmetry, residuals.symmetry);
      skewness = std::max(skewness, residuals.skewness);
      least = std::min(least, residuals.min_eigenvalue / terms.Mh.norm());
    }
  }
  std::cout << "worst over 10000 random states: torques off by " << worst
            << " (relative, Newton-Euler in 50 digits), symmetry of Mh " << symmetry
            << ", skewness of Mh. - 2 Ch " << skewness << ", least eigenvalue of Mh " << least
            << " of its norm\n";
  BOOST_TEST(worst < 1e-12);
  BOOST_TEST(symmetry < 1e-15);
  BOOST_TEST(skewness < 1e-13);
  BOOST_TEST(least > 0.001);
}

BOOST_AUTO_TEST_CASE(a_wrong_inertia_in_one_link_is_seen) {
  std::mt19937_64 engine(1);
  const RandomState state(engine);
  RigidManipulator m = uneven();
  const references::ManipulatorNumbers independent = bodies(m);
  m.distal[1].inertia *= 1 + 1e-6;
  const Vector3d torque = inverse_dynamics(m, state.motion, state.wrench).torque;
  const auto expected =
      references::newton_euler_forces(independent, state.jets(),
                                      {state.wrench(0), state.wrench(1), state.wrench(2)})
          .torque;
  double off = 0;
  for (Index i = 0; i < 3; ++i) {
    off += std::abs(torque(i) - static_cast<double>(expected[static_cast<std::size_t>(i)]));
  }
  BOOST_TEST(off > 1e-12 * torque.norm());
}

BOOST_AUTO_TEST_SUITE_END()
