#include "solver/manipulator/motion_map.h"

#include <Eigen/LU>
#include <complex>

namespace trammel::solver {

namespace {

/// The platform's circumradius in the mean: what makes its rotation comparable with its
/// translation.
double platform_size(const RigidManipulator& m) {
  double sum = 0;
  for (const Vector2d& c : m.geometry.platform) sum += c.squaredNorm();
  return std::sqrt(sum / 3);
}

/// Solves K X = rhs for the platform's motion, rows of K being (e^T, cross(c, e)).
template <class S>
class PlatformSolver {
 public:
  PlatformSolver(const RigidManipulator& m, const Vec9<S>& q) : size_(platform_size(m)) {
    Eigen::Matrix<S, 3, 3> K;
    for (Index i = 0; i < 3; ++i) {
      const Limb<S> l = limb(m, q, i);
      K.row(i) << l.e.x(), l.e.y(), cross(l.c, l.e) / size_;
    }
    lu_.compute(K);
  }
  [[nodiscard]] Eigen::Matrix<S, 3, 3> solve(const Eigen::Matrix<S, 3, 3>& rhs) const {
    Eigen::Matrix<S, 3, 3> X = lu_.solve(rhs);
    X.row(2) /= size_;
    return X;
  }

 private:
  double size_;
  Eigen::PartialPivLU<Eigen::Matrix<S, 3, 3>> lu_;
};

/// Actuator and passive rates from the platform's: `rate` is C. (or C.. with the centripetal
/// terms).
void limb_rates(const RigidManipulator& m, const Vector9d& q, Index i, const Vector2d& rate,
                Vector9d& out) {
  const Limb<double> l = limb(m, q, i);
  out(i) = inner(l.e, rate) / (l.proximal * cross(l.a, l.e));
  out(3 + i) = (inner(perp(l.e), rate) - l.proximal * inner(l.a, l.e) * out(i)) / l.distal;
}

}  // namespace

template <class S>
Eigen::Matrix<S, 9, 3> motion_map(const RigidManipulator& m, const Vec9<S>& q) {
  Eigen::Matrix<S, 3, 3> D = Eigen::Matrix<S, 3, 3>::Zero();
  for (Index i = 0; i < 3; ++i) {
    const Limb<S> l = limb(m, q, i);
    D(i, i) = l.proximal * cross(l.a, l.e);
  }
  const Eigen::Matrix<S, 3, 3> G = PlatformSolver<S>(m, q).solve(D);
  Eigen::Matrix<S, 9, 3> W;
  W.template topRows<3>().setIdentity();
  W.template bottomRows<3>() = G;
  for (Index i = 0; i < 3; ++i) {
    const Limb<S> l = limb(m, q, i);
    for (Index j = 0; j < 3; ++j) {
      const Vec2<S> velocity = G.col(j).template head<2>() + perp(l.c) * G(2, j);
      W(3 + i, j) = inner(perp(l.e), velocity) / l.distal;
    }
    W(3 + i, i) -= l.proximal * inner(l.a, l.e) / l.distal;
  }
  return W;
}

template Eigen::Matrix<double, 9, 3> motion_map(const RigidManipulator&, const Vec9<double>&);
template Eigen::Matrix<std::complex<double>, 9, 3> motion_map(const RigidManipulator&,
                                                              const Vec9<std::complex<double>>&);

Matrix93d motion_map_rate(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot,
                          const Matrix93d& W) {
  const Matrix3d G = W.bottomRows<3>();
  const double phi_dot = q_dot(8);
  Matrix3d D_dot = Matrix3d::Zero();
  Matrix3d K_dot;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const double p_dot = q_dot(3 + i);
    D_dot(i, i) = l.proximal * inner(l.a, l.e) * (p_dot - q_dot(i));
    K_dot.row(i) << -p_dot * l.e.y(), p_dot * l.e.x(), (p_dot - phi_dot) * inner(l.c, l.e);
  }
  const Matrix3d G_dot = PlatformSolver<double>(m, q).solve(D_dot - K_dot * G);
  Matrix93d W_dot = Matrix93d::Zero();
  W_dot.bottomRows<3>() = G_dot;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const double p_dot = q_dot(3 + i);
    for (Index j = 0; j < 3; ++j) {
      const Vector2d velocity = G.col(j).head<2>() + perp(l.c) * G(2, j);
      const Vector2d acceleration =
          G_dot.col(j).head<2>() + perp(l.c) * G_dot(2, j) - phi_dot * l.c * G(2, j);
      W_dot(3 + i, j) = (inner(perp(l.e), acceleration) - p_dot * inner(l.e, velocity)) / l.distal;
    }
    W_dot(3 + i, i) += l.proximal * cross(l.a, l.e) * (p_dot - q_dot(i)) / l.distal;
  }
  return W_dot;
}

Vector9d velocities(const RigidManipulator& m, const Vector9d& q, const Vector3d& velocity) {
  Vector9d q_dot;
  q_dot.tail<3>() = velocity;
  for (Index i = 0; i < 3; ++i) {
    const Vector2d rate = velocity.head<2>() + velocity(2) * perp(limb(m, q, i).c);
    limb_rates(m, q, i, rate, q_dot);
  }
  return q_dot;
}

Vector9d accelerations(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot,
                       const Vector3d& acceleration) {
  Vector9d q_ddot;
  q_ddot.tail<3>() = acceleration;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const Vector2d rate = acceleration.head<2>() + acceleration(2) * perp(l.c) -
                          q_dot(8) * q_dot(8) * l.c + l.proximal * q_dot(i) * q_dot(i) * l.a +
                          l.distal * q_dot(3 + i) * q_dot(3 + i) * l.e;
    limb_rates(m, q, i, rate, q_ddot);
  }
  return q_ddot;
}

}  // namespace trammel::solver
