// ctest: labels=manipulator;dynamics
#include "solver/manipulator/rigid_dynamics.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "tests/support/solver/numerics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(rigid_dynamics)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;

/// Returns the point at time s of the uniformly accelerated motion through p.
TrajectoryPoint along(const TrajectoryPoint& p, double s) {
  const Vector3d x =
      Vector3d(p.pose.x, p.pose.y, p.pose.phi) + s * p.velocity + s * s / 2 * p.acceleration;
  return {s, {x(0), x(1), x(2)}, p.velocity + s * p.acceleration, p.acceleration};
}

}  // namespace

BOOST_AUTO_TEST_CASE(velocities_and_accelerations_are_derivatives) {
  RandomStates random(1);
  for (const RigidManipulator& m : {rigid_manipulator(table_1_design()), uneven_bodies()})
    for (int trial = 0; trial < 50; ++trial) {
      const TrajectoryPoint p = random.point();
      const InverseDynamics d = inverse_dynamics(m, p);
      BOOST_TEST_REQUIRE(d.outcome.solved());
      const auto q = [&](double s) { return inverse_dynamics(m, along(p, s)).q; };
      const auto v = [&](double s) { return inverse_dynamics(m, along(p, s)).q_dot; };
      BOOST_TEST((richardson(q, 4e-3) - d.q_dot).norm() < 1e-8 * d.q_dot.norm());
      BOOST_TEST((richardson(v, 4e-3) - d.q_ddot).norm() < 1e-7 * d.q_ddot.norm());
      for (std::size_t b = 0; b < 7; ++b) {
        const auto position = [&](double s) {
          return inverse_dynamics(m, along(p, s)).bodies[b].position;
        };
        const auto velocity = [&](double s) {
          return inverse_dynamics(m, along(p, s)).bodies[b].velocity;
        };
        BOOST_TEST((richardson(position, 4e-3) - d.bodies[b].velocity).norm() < 1e-8);
        BOOST_TEST((richardson(velocity, 4e-3) - d.bodies[b].acceleration).norm() < 1e-6);
      }
    }
}

BOOST_AUTO_TEST_CASE(actuator_map_returns_velocities_and_energy) {
  RandomStates random(2);
  for (const RigidManipulator& m : {rigid_manipulator(table_1_design()), uneven_bodies()})
    for (int trial = 0; trial < 200; ++trial) {
      const TrajectoryPoint p = random.point();
      const RigidTerms t = rigid_terms(m, p.pose, p.velocity);
      BOOST_TEST_REQUIRE(t.outcome.solved());
      const Vector3d rates = t.q_dot.head<3>();
      BOOST_TEST((t.W * rates - t.q_dot).norm() < 1e-12 * t.q_dot.norm());
      const InverseDynamics d = inverse_dynamics(m, p);
      BOOST_TEST((t.W * d.q_ddot.head<3>() + t.W_dot * rates - d.q_ddot).norm() <
                 1e-11 * d.q_ddot.norm());
      BOOST_TEST(t.q_dot.dot(t.M * t.q_dot) / 2 == d.kinetic_energy, tolerance(1e-13));
      BOOST_TEST(rates.dot(t.Mh * rates) / 2 == d.kinetic_energy, tolerance(1e-12));
    }
}

BOOST_AUTO_TEST_CASE(torques_at_rest_hold_the_load) {
  for (const RigidManipulator& m : {rigid_manipulator(table_1_design()), uneven_bodies()}) {
    const TrajectoryPoint rest{0, {0.26, 0.15, 0.1}};
    const Vector3d wrench(10, -3, 0.4);
    const Posture posture = inverse_kinematics(m.geometry, rest.pose);
    const HoldingTorques hold = holding_torques(jacobians(m.geometry, rest.pose, posture), wrench);
    const InverseDynamics d = inverse_dynamics(m, rest, wrench);
    BOOST_TEST((d.torque - hold.torque).norm() < 1e-13 * hold.torque.norm());
    BOOST_TEST(inverse_dynamics(m, rest).torque.norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(torques_scale_with_the_square_of_speed_and_with_mass) {
  RandomStates random(8);
  const RigidManipulator m = uneven_bodies();
  RigidManipulator heavy = m;
  for (std::size_t k = 0; k < 3; ++k)
    for (RigidLink* link : {&heavy.proximal[k], &heavy.distal[k]}) {
      link->mass *= 2;
      link->inertia *= 2;
    }
  heavy.platform.mass *= 2;
  heavy.platform.inertia *= 2;
  for (int trial = 0; trial < 20; ++trial) {
    TrajectoryPoint p = random.point();
    const Vector3d torque = inverse_dynamics(m, p).torque;
    BOOST_TEST((inverse_dynamics(heavy, p).torque - 2 * torque).norm() < 1e-14 * torque.norm());
    p.velocity *= -2;
    p.acceleration *= 4;
    BOOST_TEST((inverse_dynamics(m, p).torque - 4 * torque).norm() < 1e-12 * torque.norm());
  }
}

BOOST_AUTO_TEST_CASE(rigid_bodies_have_the_masses_of_the_design) {
  ManipulatorDesign design = table_1_design();
  const RigidManipulator by_density = rigid_manipulator(design);
  BOOST_TEST(by_density.proximal[0].mass == 0.0243, tolerance(1e-14));
  BOOST_TEST(by_density.distal[2].inertia == (0.0243 * 0.04 / 12), tolerance(1e-14));
  BOOST_TEST(by_density.distal[2].center == 0.1);
  for (LinkDesign& link : design.distal) {
    link.mass = 0.0234;
    link.inertia = 0.00078;
  }
  design.platform.kind = PlatformDesign::Kind::rigid;
  design.platform.mass = 0.1205;
  design.platform.inertia = 0.000799;
  const RigidManipulator printed = rigid_manipulator(design);
  BOOST_TEST(printed.distal[1].mass == 0.0234, tolerance(1e-15));
  BOOST_TEST(printed.distal[1].inertia == 0.00078);
  BOOST_TEST(printed.platform.mass == 0.1205);
  BOOST_TEST(printed.platform.inertia == 0.000799);
}

BOOST_AUTO_TEST_CASE(unreachable_and_singular_states_have_no_torques) {
  const RigidManipulator m = rigid_manipulator(table_1_design());
  const InverseDynamics far = inverse_dynamics(m, {0, {-0.2, 0.144, 0}});
  BOOST_TEST((far.outcome.status == Status::singular));
  BOOST_TEST(far.outcome.reason.find("limb 2") == 0U);
  BOOST_TEST(far.torque.hasNaN());
  BOOST_TEST(std::isnan(far.kinetic_energy));

  RigidManipulator straight = m;
  const Pose pose{0.25, 0.144, 0};
  const double half = inverse_kinematics(m.geometry, pose).C[0].norm() / 2;
  straight.geometry.proximal[0] = straight.geometry.distal[0] = half * (1 - 1e-17);
  const InverseDynamics d = inverse_dynamics(straight, {0, pose});
  if (!d.outcome.solved()) {
    BOOST_TEST(d.outcome.reason.find("a serial singularity") == 0U);
    BOOST_TEST(d.torque.hasNaN());
  } else {
    BOOST_TEST(d.torque.allFinite());
  }
}

BOOST_AUTO_TEST_CASE(power_balances_at_every_instant) {
  RandomStates random(7);
  for (RigidManipulator m : {rigid_manipulator(table_1_design()), uneven_bodies()}) {
    m.gravity = {0, -9.81};
    for (int trial = 0; trial < 200; ++trial) {
      const TrajectoryPoint p = random.point();
      const InverseDynamics d = inverse_dynamics(m, p, 10 * random.vector());
      const double fed = d.actuator_power + d.load_power + d.gravity_power;
      const double scale = d.torque.norm() * d.q_dot.head<3>().norm();
      BOOST_TEST(std::abs(d.kinetic_power - fed) < 1e-11 * scale);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
