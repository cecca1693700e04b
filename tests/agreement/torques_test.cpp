// ctest: labels=verification;dynamics timeout=300
#include <boost/test/unit_test.hpp>

#include "references/manipulator/newton_euler.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(torques)

namespace {

using namespace trammel;
using namespace trammel::solver;
using namespace trammel::references;

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

/// Actuator torques [N m] by the Newton-Euler equations, computed with 50 digits.
Vector3d independent_torques(const RigidManipulator& m, const TrajectoryPoint& motion,
                             const Vector3d& wrench) {
  const Vector3d x(motion.pose.x, motion.pose.y, motion.pose.phi);
  std::array<references::Jet<references::Real>, 3> jets;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Index>(i);
    jets[i] = {x(k), motion.velocity(k), motion.acceleration(k)};
  }
  const auto forces =
      references::newton_euler_forces(bodies(m), jets, {wrench(0), wrench(1), wrench(2)});
  Vector3d torque;
  for (Index i = 0; i < 3; ++i)
    torque(i) = static_cast<double>(forces.torque[static_cast<std::size_t>(i)]);
  return torque;
}

}  // namespace

BOOST_AUTO_TEST_CASE(random_states_have_the_torques_of_newton_and_euler) {
  double worst = 0, symmetry = 0, skewness = 0, least = 1;
  RandomStates random(2017);
  for (RigidManipulator m : {rigid_manipulator(table_1_design()), uneven_bodies()}) {
    m.gravity = {1.5, -9.81};
    for (int trial = 0; trial < 5000; ++trial) {
      const TrajectoryPoint motion = random.point();
      const Vector3d wrench = random.vector().cwiseProduct(Vector3d(10, 10, 1));
      const InverseDynamics found = inverse_dynamics(m, motion, wrench);
      BOOST_TEST_REQUIRE(found.outcome.solved(), found.outcome.reason);
      const Vector3d expected = independent_torques(m, motion, wrench);
      worst = std::max(worst, (found.torque - expected).norm() / expected.norm());
      const RigidTerms terms = rigid_terms(m, motion.pose, motion.velocity);
      const PropertyResiduals residuals = property_residuals(m, terms);
      symmetry = std::max(symmetry, residuals.symmetry);
      skewness = std::max(skewness, residuals.skewness);
      least = std::min(least, residuals.min_eigenvalue / terms.Mh.norm());
    }
  }
  BOOST_TEST(worst < 1e-12);
  BOOST_TEST(symmetry < 1e-15);
  BOOST_TEST(skewness < 1e-13);
  BOOST_TEST(least > 0.001);
}

BOOST_AUTO_TEST_CASE(wrong_inertia_of_one_link_is_detected) {
  const TrajectoryPoint motion = RandomStates(1).point();
  RigidManipulator m = uneven_bodies();
  const Vector3d expected = independent_torques(m, motion, Vector3d::Zero());
  m.distal[1].inertia *= 1 + 1e-6;
  const Vector3d torque = inverse_dynamics(m, motion).torque;
  BOOST_TEST((torque - expected).norm() > 1e-12 * torque.norm());
}

BOOST_AUTO_TEST_SUITE_END()
