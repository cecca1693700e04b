#include "solver/manipulator/inverse_dynamics.h"

namespace trammel::solver {

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
  result.torque = terms.Mh * result.q_ddot.head<3>() + terms.Ch * result.q_dot.head<3>() +
                  terms.Nh - terms.W.bottomRows<3>().transpose() * wrench;
  result.kinetic_energy = result.potential_energy = 0;
  result.kinetic_power = result.gravity_power = 0;
  for (std::size_t b = 0; b < 7; ++b) {
    const BodyTerms& body = terms.bodies[b];
    const Vector3d v = body.J * result.q_dot, momentum = body.inertia.cwiseProduct(v);
    const Vector3d a = body.J * result.q_ddot + body.J_dot * result.q_dot;
    result.bodies[b] = {body.position, v.head<2>(),
                        a.head<2>(),   result.q[b < 6 ? static_cast<Index>(b) : 8],
                        v[2],          a[2]};
    result.kinetic_energy += momentum.dot(v) / 2;
    result.kinetic_power += momentum.dot(a);
    result.potential_energy -= body.inertia[0] * m.gravity.dot(body.position);
    result.gravity_power += momentum.head<2>().dot(m.gravity);
  }
  result.actuator_power = result.torque.dot(result.q_dot.head<3>());
  result.load_power = wrench.dot(motion.velocity);
  return result;
}

}  // namespace trammel::solver
