#include "solver/manipulator/rigid_terms.h"

#include <complex>

#include "solver/linalg/dense_eigen.h"
#include "solver/manipulator/motion_map.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

template <class S>
Eigen::Matrix<S, 9, 9> mass_matrix(const RigidManipulator& m, const Eigen::Matrix<S, 9, 1>& q) {
  Eigen::Matrix<S, 9, 9> M = Eigen::Matrix<S, 9, 9>::Zero();
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<S> l = limb(m, q, i);
    const RigidLink& p = m.proximal[k];
    const RigidLink& d = m.distal[k];
    M(i, i) = p.inertia + p.mass * p.center * p.center + d.mass * l.proximal * l.proximal;
    M(3 + i, 3 + i) = d.inertia + d.mass * d.center * d.center;
    M(i, 3 + i) = M(3 + i, i) = d.mass * l.proximal * d.center * inner(l.a, l.e);
  }
  const PlatformMass& platform = m.platform;
  const Vec2<S> lever = perp(rotated(platform.center, direction_of(q(8))));
  M(6, 6) = M(7, 7) = platform.mass;
  M(6, 8) = M(8, 6) = platform.mass * lever.x();
  M(7, 8) = M(8, 7) = platform.mass * lever.y();
  M(8, 8) = platform.inertia + platform.mass * platform.center.squaredNorm();
  return M;
}

template <class S>
Eigen::Matrix<S, 3, 3> reduced_mass(const RigidManipulator& m, const Eigen::Matrix<S, 9, 1>& q) {
  const Eigen::Matrix<S, 9, 3> W = motion_map<S>(m, q);
  return W.transpose() * mass_matrix(m, q) * W;
}

template Matrix9d mass_matrix(const RigidManipulator&, const Vector9d&);
template Eigen::Matrix<std::complex<double>, 9, 9> mass_matrix(
    const RigidManipulator&, const Eigen::Matrix<std::complex<double>, 9, 1>&);
template Matrix3d reduced_mass(const RigidManipulator&, const Vector9d&);
template Eigen::Matrix<std::complex<double>, 3, 3> reduced_mass(
    const RigidManipulator&, const Eigen::Matrix<std::complex<double>, 9, 1>&);

namespace {

/// Of Christoffel symbols.
Matrix9d coriolis_matrix(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot) {
  Matrix9d C = Matrix9d::Zero();
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<double> l = limb(m, q, i);
    // Of the coupling m l1 lc cos(theta_a - theta_p) in M.
    const double h = m.distal[k].mass * l.proximal * m.distal[k].center * cross(l.a, l.e);
    C(i, 3 + i) = -h * q_dot(3 + i);
    C(3 + i, i) = h * q_dot(i);
  }
  const Vector2d center = rotated(m.platform.center, direction_of(q(8)));
  C(6, 8) = -m.platform.mass * center.x() * q_dot(8);
  C(7, 8) = -m.platform.mass * center.y() * q_dot(8);
  return C;
}

Vector9d gravity_vector(const RigidManipulator& m, const Vector9d& q) {
  const Vector2d& g = m.gravity;
  Vector9d N;
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<double> l = limb(m, q, i);
    N(i) = -(m.proximal[k].mass * m.proximal[k].center + m.distal[k].mass * l.proximal) *
           inner(perp(l.a), g);
    N(3 + i) = -m.distal[k].mass * m.distal[k].center * inner(perp(l.e), g);
  }
  const Vector2d center = rotated(m.platform.center, direction_of(q(8)));
  N.segment<2>(6) = -m.platform.mass * g;
  N(8) = -m.platform.mass * inner(perp(center), g);
  return N;
}

Vector9d coordinates(const Pose& pose, const Posture& posture) {
  Vector9d q;
  for (Index i = 0; i < 3; ++i) {
    q(i) = posture.active[static_cast<std::size_t>(i)];
    q(3 + i) = posture.passive[static_cast<std::size_t>(i)];
  }
  q.tail<3>() << pose.x, pose.y, pose.phi;
  return q;
}

Outcome state_outcome(const Posture& posture, const ManipulatorGeometry& geometry,
                      const Pose& pose) {
  if (!posture.outcome.solved()) return posture.outcome;
  const Jacobians j = jacobians(geometry, pose, posture);
  if (!(j.parallel_distance > kSingularRatio))
    return {Status::singular,
            "a parallel singularity: the actuators do not determine the platform's motion"};
  if (!(j.serial_distance > kSingularRatio))
    return {Status::singular,
            "a serial singularity: a limb is straight or folded and its actuator does not follow "
            "from the platform's motion"};
  return {};
}

void set_nan(RigidTerms& t) {
  t.q.setConstant(kNaN);
  t.q_dot = t.N = t.q;
  t.M.setConstant(kNaN);
  t.C = t.M;
  t.W.setConstant(kNaN);
  t.W_dot = t.W;
  t.Mh.setConstant(kNaN);
  t.Ch = t.Mh;
  t.Nh.setConstant(kNaN);
}

}  // namespace

RigidTerms rigid_terms(const RigidManipulator& m, const Pose& pose, const Vector3d& velocity) {
  RigidTerms terms;
  const Posture posture = inverse_kinematics(m.geometry, pose);
  terms.outcome = state_outcome(posture, m.geometry, pose);
  if (!terms.outcome.solved()) {
    set_nan(terms);
    return terms;
  }
  terms.q = coordinates(pose, posture);
  terms.q_dot = velocities(m, terms.q, velocity);
  terms.M = mass_matrix<double>(m, terms.q);
  terms.C = coriolis_matrix(m, terms.q, terms.q_dot);
  terms.N = gravity_vector(m, terms.q);
  terms.W = motion_map<double>(m, terms.q);
  terms.W_dot = motion_map_rate(m, terms.q, terms.q_dot, terms.W);
  terms.Mh = terms.W.transpose() * terms.M * terms.W;
  terms.Ch = terms.W.transpose() * (terms.M * terms.W_dot + terms.C * terms.W);
  terms.Nh = terms.W.transpose() * terms.N;
  return terms;
}

PropertyResiduals property_residuals(const RigidManipulator& m, const RigidTerms& terms) {
  constexpr double h = 1e-30;  // so small that no rounding sees it: the step is exact
  Eigen::Matrix<std::complex<double>, 9, 1> q;
  for (Index i = 0; i < 9; ++i) q(i) = {terms.q(i), h * terms.q_dot(i)};
  const Matrix3d Mh_dot = reduced_mass<std::complex<double>>(m, q).imag() / h;
  const Matrix3d S = Mh_dot - 2 * terms.Ch;
  const double scale = Mh_dot.norm() + 2 * terms.Ch.norm();
  return {(terms.Mh - terms.Mh.transpose()).norm() / terms.Mh.norm(),
          scale > 0 ? (S + S.transpose()).norm() / scale : 0,
          symmetric_eigenpairs(terms.Mh).value(0)};
}

}  // namespace trammel::solver
