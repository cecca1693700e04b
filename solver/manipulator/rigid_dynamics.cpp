#include "solver/manipulator/rigid_dynamics.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

template <class T>
using Vec2 = Eigen::Vector2<T>;

template <Real T>
Vec2<T> perp(const Vec2<T>& a) {
  return {-a.y(), a.x()};
}
template <Real T>
Vec2<T> turned(const Vector2d& v, const T& angle) {
  using std::cos;
  using std::sin;
  const Vec2<T> along(cos(angle), sin(angle));
  return along * v.x() + perp(along) * v.y();
}

/// Unit vectors a and e along the proximal and the distal link of a limb, vector c = C_i - P, and
/// link lengths.
template <Real T>
struct Limb {
  Vec2<T> a, e, c;
  double proximal, distal;
};

template <Real T>
Limb<T> limb(const RigidManipulator& m, const Vector9<T>& q, Index i) {
  const std::size_t k = to_size(i);
  const Vector2d x = Vector2d::UnitX();
  return {turned<T>(x, q(i)), turned<T>(x, q(3 + i)), turned<T>(m.geometry.platform[k], q(8)),
          m.geometry.proximal[k], m.geometry.distal[k]};
}

RigidLink rigid_link(const LinkDesign& link, double length) {
  const double mass = link_section(link, length).mass_per_length * length;
  return {mass, length / 2, link.inertia.value_or(mass * length * length / 12)};
}

Vector3d body_inertia(const RigidManipulator& m, Index body) {
  const auto of = [](const auto& b) { return Vector3d(b.mass, b.mass, b.inertia); };
  if (body == 6) return of(m.platform);
  return of((body < 3 ? m.proximal : m.distal)[to_size(body % 3)]);
}

/// Center of mass of a body, and the matrix J that maps the rates of the nine coordinates to the
/// velocity of the body.
template <Real T>
struct BodyPlace {
  Vec2<T> position;
  Eigen::Matrix<T, 3, 9> J = Eigen::Matrix<T, 3, 9>::Zero();
};

template <Real T>
BodyPlace<T> body_place(const RigidManipulator& m, const Vector9<T>& q, Index body) {
  BodyPlace<T> place;
  const auto add_arm = [&](const Vector2d& arm, Index angle) {
    const Vec2<T> r = turned<T>(arm, q(angle));
    place.position += r;
    place.J.col(angle).template head<2>() += perp(r);
  };
  if (body == 6) {
    place.position = q.template segment<2>(6);
    place.J.template block<2, 2>(0, 6).setIdentity();
    add_arm(m.platform.center, 8);
  } else {
    const std::size_t k = to_size(body % 3);
    place.position = m.geometry.base[k].template cast<T>();
    if (body >= 3) add_arm({m.geometry.proximal[k], 0}, body - 3);
    add_arm({(body < 3 ? m.proximal : m.distal)[k].center, 0}, body);
  }
  place.J(2, body < 6 ? body : 8) = T(1);
  return place;
}

Vector9d coordinates(const Pose& pose, const Posture& posture) {
  Vector9d q;
  for (Index i = 0; i < 3; ++i) {
    q(i) = posture.active[to_size(i)];
    q(3 + i) = posture.passive[to_size(i)];
  }
  q.tail<3>() = pose.vector();
  return q;
}

Outcome state_outcome(const Posture& posture, const ManipulatorGeometry& geometry,
                      const Pose& pose) {
  if (!posture.outcome.solved()) return posture.outcome;
  const Jacobians j = jacobians(geometry, pose, posture);
  if (!(j.parallel_distance > kSingularRatio))
    return {Status::singular,
            "a parallel singularity: the actuators do not determine the motion of the platform"};
  if (!(j.serial_distance > kSingularRatio))
    return {Status::singular,
            "a serial singularity: a limb is straight or folded, so that the velocity of the "
            "platform does not determine the velocity of the actuator"};
  return {};
}

}  // namespace

RigidManipulator rigid_manipulator(const ManipulatorDesign& design) {
  check_geometry(design.geometry);
  RigidManipulator m;
  m.geometry = design.geometry;
  for (std::size_t k = 0; k < 3; ++k) {
    m.proximal[k] = rigid_link(design.proximal[k], design.geometry.proximal[k]);
    m.distal[k] = rigid_link(design.distal[k], design.geometry.distal[k]);
  }
  m.platform = platform_mass(design);
  return m;
}

Eigen::Matrix<Dual, 9, 9> mass_matrix(const RigidManipulator& m, const Vector9<Dual>& q) {
  Eigen::Matrix<Dual, 9, 9> M = Eigen::Matrix<Dual, 9, 9>::Zero();
  for (Index body = 0; body < 7; ++body) {
    const Eigen::Matrix<Dual, 3, 9> J = body_place(m, q, body).J;
    const Eigen::Vector3<Dual> inertia = body_inertia(m, body).cast<Dual>();
    const Eigen::Matrix<Dual, 9, 3> momentum = J.transpose() * inertia.asDiagonal();
    M += momentum.lazyProduct(J);
  }
  return M;
}

/// Returns the matrix W of qdot = W thetadot_a. The last three rows G of W map actuator rates to
/// the motion of the platform and follow from K G = D. The rows of K are (e^T, cross(c, e)). D is
/// diagonal with the entries l1 cross(a, e) of the limbs. The platform rotation is multiplied by
/// the platform radius, so that it is comparable with translations.
template <Real T>
Eigen::Matrix<T, 9, 3> actuator_to_joint_jacobian(const RigidManipulator& m, const Vector9<T>& q) {
  const double size = platform_radius(m.geometry);
  using Square = Eigen::Matrix<T, 3, 3>;
  Square K, D = Square::Zero();
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    K.row(i) << l.e.x(), l.e.y(), perp(l.c).dot(l.e) / size;
    D(i, i) = l.proximal * perp(l.a).dot(l.e);
  }
  Square G = Eigen::PartialPivLU<Square>(K).solve(D);
  G.row(2) /= T(size);
  Eigen::Matrix<T, 9, 3> W;
  W.template topRows<3>().setIdentity();
  W.template bottomRows<3>() = G;
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    for (Index j = 0; j < 3; ++j) {
      const Vec2<T> velocity = G.col(j).template head<2>() + perp(l.c) * G(2, j);
      W(3 + i, j) = perp(l.e).dot(velocity) / l.distal;
    }
    W(3 + i, i) -= l.proximal * l.a.dot(l.e) / l.distal;
  }
  return W;
}

template <Real T>
Vector9<T> joint_velocities(const RigidManipulator& m, const Vector9<T>& q,
                            const Eigen::Matrix<T, 3, 1>& platform_rate) {
  Vector9<T> q_dot;
  q_dot.template tail<3>() = platform_rate;
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    const Vec2<T> rate = platform_rate.template head<2>() + perp(l.c) * platform_rate(2);
    q_dot(i) = l.e.dot(rate) / (l.proximal * perp(l.a).dot(l.e));
    q_dot(3 + i) = (perp(l.e).dot(rate) - l.proximal * l.a.dot(l.e) * q_dot(i)) / l.distal;
  }
  return q_dot;
}

template Matrix93d actuator_to_joint_jacobian(const RigidManipulator&, const Vector9d&);
template Eigen::Matrix<Dual, 9, 3> actuator_to_joint_jacobian(const RigidManipulator&,
                                                              const Vector9<Dual>&);
template Vector9d joint_velocities(const RigidManipulator&, const Vector9d&, const Vector3d&);
template Vector9<Dual> joint_velocities(const RigidManipulator&, const Vector9<Dual>&,
                                        const Eigen::Matrix<Dual, 3, 1>&);

RigidTerms rigid_terms(const RigidManipulator& m, const Pose& pose, const Vector3d& velocity) {
  RigidTerms terms;
  const Posture posture = inverse_kinematics(m.geometry, pose);
  terms.outcome = state_outcome(posture, m.geometry, pose);
  if (!terms.outcome.solved()) return terms;
  terms.q = coordinates(pose, posture);
  terms.q_dot = joint_velocities<double>(m, terms.q, velocity);
  const Vector9<Dual> q = with_rates(terms.q, terms.q_dot);
  terms.M.setZero();
  terms.C.setZero();
  terms.N.setZero();
  for (Index b = 0; b < 7; ++b) {
    const BodyPlace<Dual> place = body_place(m, q, b);
    BodyTerms& body = terms.bodies[to_size(b)];
    body = {body_inertia(m, b), values_of(place.position), values_of(place.J), rates_of(place.J)};
    const Matrix93d momentum = body.J.transpose() * body.inertia.asDiagonal();
    terms.M += momentum.lazyProduct(body.J);
    terms.C += momentum.lazyProduct(body.J_dot);
    terms.N -= momentum.leftCols<2>() * m.gravity;
  }
  const Eigen::Matrix<Dual, 9, 3> W = actuator_to_joint_jacobian(m, q);
  terms.W = values_of(W);
  terms.W_dot = rates_of(W);
  // Small matrices are multiplied without Eigen's blocked kernel, which takes long to compile.
  const Matrix93d inertia = terms.M.lazyProduct(terms.W);
  const Matrix93d coriolis = terms.M.lazyProduct(terms.W_dot) + terms.C.lazyProduct(terms.W);
  terms.Mh = terms.W.transpose().lazyProduct(inertia);
  terms.Ch = terms.W.transpose().lazyProduct(coriolis);
  terms.Nh = terms.W.transpose() * terms.N;
  return terms;
}

PropertyResiduals property_residuals(const RigidManipulator& m, const RigidTerms& terms) {
  const Vector9<Dual> q = with_rates(terms.q, terms.q_dot);
  const Eigen::Matrix<Dual, 9, 3> W = actuator_to_joint_jacobian<Dual>(m, q);
  const Eigen::Matrix<Dual, 9, 3> inertia = mass_matrix(m, q).lazyProduct(W);
  const Eigen::Matrix<Dual, 3, 3> Mh = W.transpose().lazyProduct(inertia);
  const Matrix3d Mh_dot = rates_of(Mh);
  const Matrix3d S = Mh_dot - 2 * terms.Ch;
  const double scale = Mh_dot.norm() + 2 * terms.Ch.norm();
  return {(terms.Mh - terms.Mh.transpose()).norm() / terms.Mh.norm(),
          scale > 0 ? (S + S.transpose()).norm() / scale : 0,
          symmetric_eigenpairs(terms.Mh).value(0)};
}

InverseDynamics inverse_dynamics(const RigidManipulator& m, const TrajectoryPoint& motion,
                                 const Vector3d& wrench) {
  InverseDynamics result;
  const RigidTerms terms = rigid_terms(m, motion.pose, motion.velocity);
  result.outcome = terms.outcome;
  if (!result.outcome.solved()) return result;
  result.q = terms.q;
  result.q_dot = terms.q_dot;
  result.q_ddot = rates_of(joint_velocities<Dual>(
      m, with_rates(terms.q, terms.q_dot), with_rates(motion.velocity, motion.acceleration)));
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
