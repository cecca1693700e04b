// ctest: labels=manipulator;dynamics
#include "solver/manipulator/rigid_dynamics.h"

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/manipulator/trajectory.h"
#include "tests/support/solver/differences.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(rigid_dynamics)

namespace {

using namespace trammel::solver;

constexpr double kPi = std::numbers::pi;

RigidManipulator table_1_bodies() {
  return rigid_manipulator(table_1_design());
}

/// Unequal links with centres of mass off the middle, P off the platform's centre of mass.
RigidManipulator uneven_bodies() {
  RigidManipulator m;
  m.geometry = uneven_geometry();
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<double>(k);
    m.proximal[k] = {0.02 + 0.01 * i, 0.07 + 0.02 * i, 1e-4 + 3e-5 * i};
    m.distal[k] = {0.03 - 0.005 * i, 0.12 - 0.01 * i, 2e-4 - 4e-5 * i};
  }
  m.platform = {0.12, 7e-4, Vector2d(0.01, -0.02)};
  return m;
}

/// Seeded random states near the middle of the workspace, of the order of 1 rad/s and m/s.
class RandomStates {
 public:
  explicit RandomStates(unsigned seed) : engine_(seed) {}
  double uniform() { return std::uniform_real_distribution<double>(-1, 1)(engine_); }
  Vector3d vector() {
    const double x = uniform();
    const double y = uniform();
    return {x, y, uniform()};
  }
  TrajectoryPoint point() {
    TrajectoryPoint p;
    const Vector3d v = vector();
    p.pose = {0.26 + 0.03 * v(0), 0.145 + 0.03 * v(1), 0.25 * v(2)};
    p.velocity = vector();
    p.acceleration = 3 * vector();
    return p;
  }

 private:
  std::mt19937_64 engine_;
};

/// The point of the uniformly accelerated motion through p at the time s.
TrajectoryPoint along(const TrajectoryPoint& p, double s) {
  const Vector3d x =
      Vector3d(p.pose.x, p.pose.y, p.pose.phi) + s * p.velocity + s * s / 2 * p.acceleration;
  return {s, {x(0), x(1), x(2)}, p.velocity + s * p.acceleration, p.acceleration};
}

}  // namespace

BOOST_AUTO_TEST_CASE(velocities_and_accelerations_are_derivatives_of_the_inverse_kinematics) {
  RandomStates random(1);
  for (const RigidManipulator& m : {table_1_bodies(), uneven_bodies()}) {
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
}

BOOST_AUTO_TEST_CASE(the_map_W_gives_all_velocities_from_the_actuators_and_W_dot_is_its_rate) {
  RandomStates random(2);
  for (const RigidManipulator& m : {table_1_bodies(), uneven_bodies()}) {
    for (int trial = 0; trial < 200; ++trial) {
      const TrajectoryPoint p = random.point();
      const RigidTerms t = rigid_terms(m, p.pose, p.velocity);
      BOOST_TEST_REQUIRE(t.outcome.solved());
      BOOST_TEST((t.W * t.q_dot.head<3>() - t.q_dot).norm() < 1e-12 * t.q_dot.norm());
      const Matrix93d rate = richardson(
          [&](double s) -> Matrix93d { return motion_map<double>(m, t.q + s * t.q_dot); }, 4e-3);
      BOOST_TEST((t.W_dot - rate).norm() < 1e-8 * (1 + t.W.norm()) * (rate.norm() + 1));
      const InverseDynamics d = inverse_dynamics(m, p);
      BOOST_TEST((t.W * d.q_ddot.head<3>() + t.W_dot * d.q_dot.head<3>() - d.q_ddot).norm() <
                 1e-11 * d.q_ddot.norm());
    }
  }
}

BOOST_AUTO_TEST_CASE(the_quadratic_form_of_M_is_the_energy_of_the_bodies) {
  RandomStates random(3);
  for (const RigidManipulator& m : {table_1_bodies(), uneven_bodies()}) {
    for (int trial = 0; trial < 200; ++trial) {
      const TrajectoryPoint p = random.point();
      const RigidTerms t = rigid_terms(m, p.pose, p.velocity);
      const double energy = inverse_dynamics(m, p).kinetic_energy;
      const Vector3d rates = t.q_dot.head<3>();
      BOOST_TEST(std::abs(t.q_dot.dot(t.M * t.q_dot) / 2 - energy) < 1e-13 * energy);
      BOOST_TEST(std::abs(rates.dot(t.Mh * rates) / 2 - energy) < 1e-12 * energy);
    }
  }
}

BOOST_AUTO_TEST_CASE(Mh_is_symmetric_positive_definite_and_Mh_dot_minus_2_Ch_is_skew) {
  RandomStates random(4);
  double worst_skew = 0;
  double worst_symmetry = 0;
  double smallest = 1;
  for (const RigidManipulator& m : {table_1_bodies(), uneven_bodies()}) {
    for (int trial = 0; trial < 10000; ++trial) {
      const TrajectoryPoint p = random.point();
      const RigidTerms t = rigid_terms(m, p.pose, p.velocity);
      if (!t.outcome.solved()) BOOST_FAIL(t.outcome.reason);
      const Vector9<Dual> q = with_rates(t.q, t.q_dot);
      const Eigen::Matrix<Dual, 9, 3> W = motion_map<Dual>(m, q);
      const Eigen::Matrix<Dual, 3, 3> Mh = W.transpose() * mass_matrix(m, q) * W;
      const Matrix3d Mh_dot = rates_of(Mh);
      const Matrix3d S = Mh_dot - 2 * t.Ch;
      worst_skew = std::max(worst_skew, (S + S.transpose()).norm() / S.norm());
      worst_symmetry = std::max(worst_symmetry, (t.Mh - t.Mh.transpose()).norm() / t.Mh.norm());
      const Vector3d lambda = Eigen::SelfAdjointEigenSolver<Matrix3d>(t.Mh).eigenvalues();
      smallest = std::min(smallest, lambda(0) / lambda(2));
    }
  }
  BOOST_TEST_MESSAGE("skewness " << worst_skew << ", symmetry " << worst_symmetry
                                 << ", least eigenvalue ratio " << smallest);
  BOOST_TEST(worst_skew < 1e-11);
  BOOST_TEST(worst_symmetry < 1e-14);
  BOOST_TEST(smallest > 0);
}

BOOST_AUTO_TEST_CASE(M_dot_minus_2_C_is_skew_in_all_nine_coordinates) {
  RandomStates random(5);
  const RigidManipulator m = uneven_bodies();
  for (int trial = 0; trial < 200; ++trial) {
    const TrajectoryPoint p = random.point();
    const RigidTerms t = rigid_terms(m, p.pose, p.velocity);
    const Matrix9d M_dot = rates_of(mass_matrix(m, with_rates(t.q, t.q_dot)));
    const Matrix9d S = M_dot - 2 * t.C;
    BOOST_TEST((S + S.transpose()).norm() < 1e-14 * S.norm());
  }
}

BOOST_AUTO_TEST_CASE(torques_do_the_virtual_work_that_inertia_gravity_and_load_leave) {
  // D'Alembert, body by body: no M, C, N or W in it.
  RandomStates random(6);
  for (RigidManipulator m : {table_1_bodies(), uneven_bodies()}) {
    m.gravity = {1.5, -9.81};
    for (int trial = 0; trial < 100; ++trial) {
      const TrajectoryPoint p = random.point();
      const Vector3d wrench = 10 * random.vector();
      const InverseDynamics d = inverse_dynamics(m, p, wrench);
      for (Index direction = 0; direction < 3; ++direction) {
        TrajectoryPoint virtual_motion = p;
        virtual_motion.velocity = Vector3d::Unit(direction);
        const InverseDynamics v = inverse_dynamics(m, virtual_motion);
        double work = d.torque.dot(v.q_dot.head<3>()) + wrench(direction);
        double scale = std::abs(work) + d.torque.norm() * v.q_dot.head<3>().norm();
        for (std::size_t b = 0; b < 7; ++b) {
          const double mass = b < 3   ? m.proximal[b].mass
                              : b < 6 ? m.distal[b - 3].mass
                                      : m.platform.mass;
          const double inertia = b < 3   ? m.proximal[b].inertia
                                 : b < 6 ? m.distal[b - 3].inertia
                                         : m.platform.inertia;
          work -= mass * (d.bodies[b].acceleration - m.gravity).dot(v.bodies[b].velocity) +
                  inertia * d.bodies[b].angular_acceleration * v.bodies[b].angular_velocity;
        }
        BOOST_TEST(std::abs(work) < 1e-11 * scale);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(power_balances_at_every_instant) {
  RandomStates random(7);
  for (RigidManipulator m : {table_1_bodies(), uneven_bodies()}) {
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

BOOST_AUTO_TEST_CASE(the_rate_of_the_kinetic_energy_is_its_derivative_along_the_circle) {
  const RigidManipulator m = uneven_bodies();
  const Path circle = Circle{{0.27, 0.14}, 0.01, 3, 0.1};
  for (const double t : {0.0, 0.4, 1.3}) {
    const auto energy = [&](double s) {
      return Eigen::Matrix<double, 1, 1>(inverse_dynamics(m, at(circle, t + s)).kinetic_energy);
    };
    const double rate = inverse_dynamics(m, at(circle, t)).kinetic_power;
    BOOST_TEST(std::abs(richardson(energy, 1e-2)(0) - rate) < 1e-8 * std::abs(rate));
  }
}

BOOST_AUTO_TEST_CASE(over_a_full_circle_the_actuators_do_no_work_against_conservative_loads) {
  // The trapezoid rule over a period converges faster than any power of the step.
  for (const Vector2d& gravity : {Vector2d(0, 0), Vector2d(0, -9.81)}) {
    for (const Vector3d& load : {Vector3d(0, 0, 0), Vector3d(10, 0, 0)}) {
      RigidManipulator m = table_1_bodies();
      m.gravity = gravity;
      double work = 0;
      double turnover = 0;
      const int n = 64;
      for (int k = 0; k < n; ++k) {
        const double t = 2 * kPi * k / n;
        const InverseDynamics d = inverse_dynamics(m, at(Circle{{0.25, 0.144}, 0.01}, t), load);
        work += d.actuator_power * 2 * kPi / n;
        turnover += std::abs(d.actuator_power) * 2 * kPi / n;
      }
      BOOST_TEST(std::abs(work) < 1e-13 * turnover);
      BOOST_TEST(turnover > 1e-7);
    }
  }
}

BOOST_AUTO_TEST_CASE(at_rest_the_torques_are_those_that_hold_the_load) {
  for (const RigidManipulator& m : {table_1_bodies(), uneven_bodies()}) {
    const TrajectoryPoint rest{0, {0.26, 0.15, 0.1}};
    const Vector3d wrench(10, -3, 0.4);
    const Posture posture = inverse_kinematics(m.geometry, rest.pose);
    const HoldingTorques hold = holding_torques(jacobians(m.geometry, rest.pose, posture), wrench);
    const InverseDynamics d = inverse_dynamics(m, rest, wrench);
    BOOST_TEST((d.torque - hold.torque).norm() < 1e-13 * hold.torque.norm());
    BOOST_TEST(inverse_dynamics(m, rest).torque.norm() == 0.0);
  }
}

BOOST_AUTO_TEST_CASE(gravity_weighs_as_the_gradient_of_the_potential) {
  RigidManipulator m = uneven_bodies();
  m.gravity = {2, -9.81};
  const TrajectoryPoint rest{0, {0.26, 0.15, 0.1}};
  const auto potential = [&](const InverseDynamics& d) {
    double V = -m.platform.mass * m.gravity.dot(d.bodies[6].position);
    for (std::size_t k = 0; k < 3; ++k)
      V -= m.gravity.dot(m.proximal[k].mass * d.bodies[k].position +
                         m.distal[k].mass * d.bodies[3 + k].position);
    return V;
  };
  const InverseDynamics d = inverse_dynamics(m, rest);
  for (Index direction = 0; direction < 3; ++direction) {
    TrajectoryPoint moving = rest;
    moving.velocity = Vector3d::Unit(direction);
    const auto V = [&](double s) {
      return Eigen::Matrix<double, 1, 1>(potential(inverse_dynamics(m, along(moving, s))));
    };
    const double power = d.torque.dot(inverse_dynamics(m, moving).q_dot.head<3>());
    BOOST_TEST(std::abs(richardson(V, 4e-3)(0) - power) < 1e-9);
  }
}

BOOST_AUTO_TEST_CASE(twice_as_fast_takes_four_times_the_torque_and_backwards_the_same) {
  RandomStates random(8);
  const RigidManipulator m = uneven_bodies();
  for (int trial = 0; trial < 20; ++trial) {
    TrajectoryPoint p = random.point();
    const Vector3d torque = inverse_dynamics(m, p).torque;
    p.velocity *= -1;
    BOOST_TEST((inverse_dynamics(m, p).torque - torque).norm() < 1e-12 * torque.norm());
    p.velocity *= 2;
    p.acceleration *= 4;
    BOOST_TEST((inverse_dynamics(m, p).torque - 4 * torque).norm() < 1e-12 * torque.norm());
  }
}

BOOST_AUTO_TEST_CASE(twice_the_mass_takes_twice_the_torque) {
  RandomStates random(9);
  const RigidManipulator m = uneven_bodies();
  RigidManipulator heavy = m;
  for (std::size_t k = 0; k < 3; ++k) {
    for (RigidLink* link : {&heavy.proximal[k], &heavy.distal[k]}) {
      link->mass *= 2;
      link->inertia *= 2;
    }
  }
  heavy.platform.mass *= 2;
  heavy.platform.inertia *= 2;
  const TrajectoryPoint p = random.point();
  const Vector3d torque = inverse_dynamics(m, p).torque;
  BOOST_TEST((inverse_dynamics(heavy, p).torque - 2 * torque).norm() < 1e-14 * torque.norm());
}

BOOST_AUTO_TEST_CASE(the_bodies_of_a_design_have_its_masses) {
  ManipulatorDesign design = table_1_design();
  const RigidManipulator by_density = rigid_manipulator(design);
  BOOST_TEST(std::abs(by_density.proximal[0].mass / 0.0243 - 1) < 1e-14);
  BOOST_TEST(std::abs(by_density.distal[2].inertia / (0.0243 * 0.04 / 12) - 1) < 1e-14);
  BOOST_TEST(by_density.distal[2].center == 0.1);
  for (LinkDesign& link : design.distal) {
    link.mass = 0.0234;
    link.inertia = 0.00078;
  }
  design.platform.kind = PlatformDesign::Kind::rigid;
  design.platform.mass = 0.1205;
  design.platform.inertia = 0.000799;
  const RigidManipulator printed = rigid_manipulator(design);
  BOOST_TEST(std::abs(printed.distal[1].mass / 0.0234 - 1) < 1e-15);
  BOOST_TEST(printed.distal[1].inertia == 0.00078);
  BOOST_TEST(printed.platform.mass == 0.1205);
  BOOST_TEST(printed.platform.inertia == 0.000799);
}

BOOST_AUTO_TEST_CASE(states_without_a_finite_answer_are_outcomes_and_not_numbers) {
  const RigidManipulator m = table_1_bodies();
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

BOOST_AUTO_TEST_SUITE_END()
