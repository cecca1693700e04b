#include "solver/manipulator/inverse_dynamics.h"

#include <cmath>

#include "solver/model/plane.h"

namespace trammel::solver {

namespace {

/// A point at the vector r on a body that turns, carried by a point that moves.
BodyMotion carried(const BodyMotion& carrier, const Vector2d& r, double angle, double omega,
                   double alpha) {
  return {carrier.position + r,
          carrier.velocity + omega * perpendicular(r),
          carrier.acceleration + alpha * perpendicular(r) - omega * omega * r,
          angle,
          omega,
          alpha};
}

std::array<BodyMotion, 7> body_motions(const RigidManipulator& m, const Vector9d& q,
                                       const Vector9d& v, const Vector9d& w) {
  std::array<BodyMotion, 7> bodies;
  const auto along = [&q](Index i) { return Vector2d(std::cos(q(i)), std::sin(q(i))); };
  for (Index i = 0; i < 3; ++i) {
    const std::size_t k = to_size(i);
    const Index p = 3 + i;
    const BodyMotion base{m.geometry.base[k], Vector2d::Zero(), Vector2d::Zero()};
    const BodyMotion elbow = carried(base, m.geometry.proximal[k] * along(i), q(i), v(i), w(i));
    bodies[k] = carried(base, m.proximal[k].center * along(i), q(i), v(i), w(i));
    bodies[3 + k] = carried(elbow, m.distal[k].center * along(p), q(p), v(p), w(p));
  }
  const BodyMotion P{q.segment<2>(6), v.segment<2>(6), w.segment<2>(6)};
  bodies[6] = carried(P, rotated(m.platform.center, q(8)), q(8), v(8), w(8));
  return bodies;
}

void set_energies(const RigidManipulator& m, InverseDynamics& result) {
  result.kinetic_energy = result.potential_energy = 0;
  result.kinetic_power = result.gravity_power = 0;
  const auto add = [&](const BodyMotion& b, double mass, double inertia) {
    result.kinetic_energy +=
        (mass * b.velocity.squaredNorm() + inertia * b.angular_velocity * b.angular_velocity) / 2;
    result.kinetic_power += mass * b.velocity.dot(b.acceleration) +
                            inertia * b.angular_velocity * b.angular_acceleration;
    result.potential_energy -= mass * m.gravity.dot(b.position);
    result.gravity_power += mass * m.gravity.dot(b.velocity);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    add(result.bodies[k], m.proximal[k].mass, m.proximal[k].inertia);
    add(result.bodies[3 + k], m.distal[k].mass, m.distal[k].inertia);
  }
  add(result.bodies[6], m.platform.mass, m.platform.inertia);
}

}  // namespace

InverseDynamics inverse_dynamics(const RigidManipulator& m, const TrajectoryPoint& motion,
                                 const Vector3d& wrench) {
  InverseDynamics result;
  const RigidTerms terms = rigid_terms(m, motion.pose, motion.velocity);
  result.outcome = terms.outcome;
  if (!result.outcome.solved()) return result;
  result.q = terms.q;
  result.q_dot = terms.q_dot;
  result.q_ddot = rates_of(velocities<Dual>(m, with_rates(terms.q, terms.q_dot),
                                            with_rates(motion.velocity, motion.acceleration)));
  result.bodies = body_motions(m, result.q, result.q_dot, result.q_ddot);
  result.torque = terms.Mh * result.q_ddot.head<3>() + terms.Ch * result.q_dot.head<3>() +
                  terms.Nh - terms.W.bottomRows<3>().transpose() * wrench;
  set_energies(m, result);
  result.actuator_power = result.torque.dot(result.q_dot.head<3>());
  result.load_power = wrench.dot(motion.velocity);
  return result;
}

}  // namespace trammel::solver
