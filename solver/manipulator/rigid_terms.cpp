#include "solver/manipulator/rigid_terms.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/plane.h"

namespace trammel::solver {

namespace {

template <class T>
using Vec2 = Eigen::Vector2<T>;

template <Real T>
T cross2(const Vec2<T>& a, const Vec2<T>& b) {
  return a.x() * b.y() - a.y() * b.x();
}
template <Real T>
Vec2<T> perp(const Vec2<T>& a) {
  return {-a.y(), a.x()};
}
template <Real T>
Vec2<T> turned(const Vector2d& v, const T& angle) {
  using std::cos;
  using std::sin;
  const T c = cos(angle);
  const T s = sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Unit vectors a, e along proximal and distal links, and c = C_i - P.
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

/// Of Christoffel symbols.
Matrix9d coriolis_matrix(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot) {
  Matrix9d C = Matrix9d::Zero();
  for (Index i = 0; i < 3; ++i) {
    const auto k = to_size(i);
    const Limb<double> l = limb<double>(m, q, i);
    // Of the coupling m l1 lc cos(theta_a - theta_p) in M.
    const double h = m.distal[k].mass * l.proximal * m.distal[k].center * cross(l.a, l.e);
    C(i, 3 + i) = -h * q_dot(3 + i);
    C(3 + i, i) = h * q_dot(i);
  }
  const Vector2d center = rotated(m.platform.center, q(8));
  C(6, 8) = -m.platform.mass * center.x() * q_dot(8);
  C(7, 8) = -m.platform.mass * center.y() * q_dot(8);
  return C;
}

Vector9d gravity_vector(const RigidManipulator& m, const Vector9d& q) {
  const Vector2d& g = m.gravity;
  Vector9d N;
  for (Index i = 0; i < 3; ++i) {
    const auto k = to_size(i);
    const Limb<double> l = limb<double>(m, q, i);
    N(i) = -(m.proximal[k].mass * m.proximal[k].center + m.distal[k].mass * l.proximal) *
           perpendicular(l.a).dot(g);
    N(3 + i) = -m.distal[k].mass * m.distal[k].center * perpendicular(l.e).dot(g);
  }
  const Vector2d center = rotated(m.platform.center, q(8));
  N.segment<2>(6) = -m.platform.mass * g;
  N(8) = -m.platform.mass * perpendicular(center).dot(g);
  return N;
}

Vector9d coordinates(const Pose& pose, const Posture& posture) {
  Vector9d q;
  for (Index i = 0; i < 3; ++i) {
    q(i) = posture.active[to_size(i)];
    q(3 + i) = posture.passive[to_size(i)];
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

template <Real T>
Eigen::Matrix<T, 9, 9> mass_matrix(const RigidManipulator& m, const Vector9<T>& q) {
  Eigen::Matrix<T, 9, 9> M = Eigen::Matrix<T, 9, 9>::Zero();
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    const RigidLink& p = m.proximal[to_size(i)];
    const RigidLink& d = m.distal[to_size(i)];
    M(i, i) = p.inertia + p.mass * p.center * p.center + d.mass * l.proximal * l.proximal;
    M(3 + i, 3 + i) = d.inertia + d.mass * d.center * d.center;
    M(i, 3 + i) = M(3 + i, i) = d.mass * l.proximal * d.center * l.a.dot(l.e);
  }
  const PlatformMass& platform = m.platform;
  const Vec2<T> lever = perp(turned<T>(platform.center, q(8)));
  M(6, 6) = M(7, 7) = platform.mass;
  M(6, 8) = M(8, 6) = platform.mass * lever.x();
  M(7, 8) = M(8, 7) = platform.mass * lever.y();
  M(8, 8) = platform.inertia + platform.mass * platform.center.squaredNorm();
  return M;
}

/// Solves K G = D for the platform's motion, rows of K being (e^T, cross(c, e)); its rotation is
/// scaled to be comparable with its translation.
template <Real T>
Eigen::Matrix<T, 9, 3> motion_map(const RigidManipulator& m, const Vector9<T>& q) {
  const double size = platform_radius(m.geometry);
  using Square = Eigen::Matrix<T, 3, 3>;
  Square K, D = Square::Zero();
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    K.row(i) << l.e.x(), l.e.y(), cross2(l.c, l.e) / size;
    D(i, i) = l.proximal * cross2(l.a, l.e);
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
Vector9<T> velocities(const RigidManipulator& m, const Vector9<T>& q,
                      const Eigen::Matrix<T, 3, 1>& platform) {
  Vector9<T> q_dot;
  q_dot.template tail<3>() = platform;
  for (Index i = 0; i < 3; ++i) {
    const Limb<T> l = limb(m, q, i);
    const Vec2<T> rate = platform.template head<2>() + perp(l.c) * platform(2);
    q_dot(i) = l.e.dot(rate) / (l.proximal * cross2(l.a, l.e));
    q_dot(3 + i) = (perp(l.e).dot(rate) - l.proximal * l.a.dot(l.e) * q_dot(i)) / l.distal;
  }
  return q_dot;
}

template Matrix9d mass_matrix(const RigidManipulator&, const Vector9d&);
template Eigen::Matrix<Dual, 9, 9> mass_matrix(const RigidManipulator&, const Vector9<Dual>&);
template Matrix93d motion_map(const RigidManipulator&, const Vector9d&);
template Eigen::Matrix<Dual, 9, 3> motion_map(const RigidManipulator&, const Vector9<Dual>&);
template Vector9d velocities(const RigidManipulator&, const Vector9d&, const Vector3d&);
template Vector9<Dual> velocities(const RigidManipulator&, const Vector9<Dual>&,
                                  const Eigen::Matrix<Dual, 3, 1>&);

RigidTerms rigid_terms(const RigidManipulator& m, const Pose& pose, const Vector3d& velocity) {
  RigidTerms terms;
  const Posture posture = inverse_kinematics(m.geometry, pose);
  terms.outcome = state_outcome(posture, m.geometry, pose);
  if (!terms.outcome.solved()) return terms;
  terms.q = coordinates(pose, posture);
  terms.q_dot = velocities<double>(m, terms.q, velocity);
  terms.M = mass_matrix<double>(m, terms.q);
  terms.C = coriolis_matrix(m, terms.q, terms.q_dot);
  terms.N = gravity_vector(m, terms.q);
  const auto W = motion_map<Dual>(m, with_rates(terms.q, terms.q_dot));
  terms.W = W.unaryExpr([](const Dual& x) { return x.value(); });
  terms.W_dot = rates_of(W);
  terms.Mh = terms.W.transpose() * terms.M * terms.W;
  terms.Ch = terms.W.transpose() * (terms.M * terms.W_dot + terms.C * terms.W);
  terms.Nh = terms.W.transpose() * terms.N;
  return terms;
}

PropertyResiduals property_residuals(const RigidManipulator& m, const RigidTerms& terms) {
  const Vector9<Dual> q = with_rates(terms.q, terms.q_dot);
  const Eigen::Matrix<Dual, 9, 3> W = motion_map<Dual>(m, q);
  const Eigen::Matrix<Dual, 3, 3> Mh = W.transpose() * mass_matrix<Dual>(m, q) * W;
  const Matrix3d Mh_dot = rates_of(Mh);
  const Matrix3d S = Mh_dot - 2 * terms.Ch;
  const double scale = Mh_dot.norm() + 2 * terms.Ch.norm();
  return {(terms.Mh - terms.Mh.transpose()).norm() / terms.Mh.norm(),
          scale > 0 ? (S + S.transpose()).norm() / scale : 0,
          symmetric_eigenpairs(terms.Mh).value(0)};
}

}  // namespace trammel::solver
