#include "solver/large_motion/elements/triangle.h"

#include <cmath>

namespace trammel::solver::large_motion {

namespace {

template <int Nodes>
Eigen::Matrix<double, Nodes, 1> shape_functions(double r, double s) {
  const double t = 1 - r - s;
  Eigen::Matrix<double, Nodes, 1> n;
  if constexpr (Nodes == 3) {
    n << t, r, s;
  } else {
    n << t * (2 * t - 1), r * (2 * r - 1), s * (2 * s - 1), 4 * t * r, 4 * r * s, 4 * s * t;
  }
  return n;
}

template <int Nodes>
Eigen::Matrix<double, 2, Nodes> local_gradients(double r, double s) {
  Eigen::Matrix<double, 2, Nodes> d;
  if constexpr (Nodes == 3) {
    d << -1, 1, 0, -1, 0, 1;
  } else {
    const double t = 1 - r - s;
    d << 1 - 4 * t, 4 * r - 1, 0, 4 * (t - r), 4 * s, -4 * s,  //
        1 - 4 * t, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (t - s);
  }
  return d;
}

struct Point {
  double r, s, weight;
};

/// Interior rules on the triangle, weights summing to 1: degree 1, 2 or 4.
constexpr std::array<Point, 1> kCentroidRule = {{{1.0 / 3, 1.0 / 3, 1}}};
constexpr std::array<Point, 3> kThreePointRule = {
    {{1.0 / 6, 1.0 / 6, 1.0 / 3}, {2.0 / 3, 1.0 / 6, 1.0 / 3}, {1.0 / 6, 2.0 / 3, 1.0 / 3}}};
constexpr double kA4 = 0.44594849091596488632, kB4 = 0.09157621350977074346;
constexpr double kWeightA = 0.22338158967801146570, kWeightB = 0.10995174365532186764;
constexpr std::array<Point, 6> kSixPointRule = {{{kA4, kA4, kWeightA},
                                                 {1 - 2 * kA4, kA4, kWeightA},
                                                 {kA4, 1 - 2 * kA4, kWeightA},
                                                 {kB4, kB4, kWeightB},
                                                 {1 - 2 * kB4, kB4, kWeightB},
                                                 {kB4, 1 - 2 * kB4, kWeightB}}};

}  // namespace

template <int Nodes>
Triangle2d<Nodes>::Triangle2d(const Material& material, double thickness,
                              const std::array<Eigen::Vector2d, Nodes>& corners) {
  const double E = material.E, nu = material.nu;
  D_ << 1, nu, 0, nu, 1, 0, 0, 0, (1 - nu) / 2;
  D_ *= E / (1 - nu * nu);
  Eigen::Matrix<double, 2, Nodes> X;
  for (int a = 0; a < Nodes; ++a) X.col(a) = corners[static_cast<std::size_t>(a)];
  const auto jacobian = [&](double r, double s) {
    const Eigen::Matrix2d F = X * local_gradients<Nodes>(r, s).transpose();
    if (!(std::abs(F.determinant()) > 0)) throw ModelError("a triangle has no area");
    return F;
  };
  const auto prepare = [&](const auto& rule) {
    for (std::size_t p = 0; p < static_cast<std::size_t>(kPoints); ++p) {
      const Eigen::Matrix2d F = jacobian(rule[p].r, rule[p].s);
      gradients_[p] = F.inverse().transpose() * local_gradients<Nodes>(rule[p].r, rule[p].s);
      volume_[p] = thickness * rule[p].weight * std::abs(F.determinant()) / 2;
    }
  };
  if constexpr (Nodes == 3) {
    prepare(kCentroidRule);
  } else {
    prepare(kThreePointRule);
  }
  mass_.setZero();
  for (const Point& p : kSixPointRule) {
    const double m =
        material.rho * thickness * p.weight * std::abs(jacobian(p.r, p.s).determinant()) / 2;
    const Eigen::Matrix<double, Nodes, 1> n = shape_functions<Nodes>(p.r, p.s);
    for (int a = 0; a < Nodes; ++a) {
      for (int b = 0; b < Nodes; ++b) {
        mass_.template block<2, 2>(2 * a, 2 * b) += m * n[a] * n[b] * Eigen::Matrix2d::Identity();
      }
    }
  }
}

template <int Nodes>
Eigen::Matrix2d Triangle2d<Nodes>::displacement_gradient(const Gradients& gradients,
                                                         const Coordinates& q) {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  for (int a = 0; a < Nodes; ++a) {
    H += q.template segment<2>(2 * a) * gradients.col(a).transpose();
  }
  return H;
}

template <int Nodes>
typename Triangle2d<Nodes>::Strain Triangle2d<Nodes>::strain(const Eigen::Matrix2d& H) {
  return {H(0, 0) + H.col(0).squaredNorm() / 2, H(1, 1) + H.col(1).squaredNorm() / 2,
          H(0, 1) + H(1, 0) + H.col(0).dot(H.col(1))};
}

template <int Nodes>
typename Triangle2d<Nodes>::Operator Triangle2d<Nodes>::strain_operator(const Gradients& gradients,
                                                                        const Eigen::Matrix2d& H) {
  const Eigen::Matrix2d F = Eigen::Matrix2d::Identity() + H;
  Operator B;
  for (int a = 0; a < Nodes; ++a) {
    B.template block<1, 2>(0, 2 * a) = gradients(0, a) * F.col(0).transpose();
    B.template block<1, 2>(1, 2 * a) = gradients(1, a) * F.col(1).transpose();
    B.template block<1, 2>(2, 2 * a) =
        gradients(1, a) * F.col(0).transpose() + gradients(0, a) * F.col(1).transpose();
  }
  return B;
}

template <int Nodes>
double Triangle2d<Nodes>::energy(const Coordinates& q) const {
  double sum = 0;
  for (std::size_t p = 0; p < static_cast<std::size_t>(kPoints); ++p) {
    const Strain e = strain(displacement_gradient(gradients_[p], q));
    sum += volume_[p] / 2 * e.dot(D_ * e);
  }
  return sum;
}

template <int Nodes>
typename Triangle2d<Nodes>::Coordinates Triangle2d<Nodes>::forces(const Coordinates& q,
                                                                  const Coordinates& v,
                                                                  double tau) const {
  Coordinates f = Coordinates::Zero();
  for (std::size_t p = 0; p < static_cast<std::size_t>(kPoints); ++p) {
    const Eigen::Matrix2d H = displacement_gradient(gradients_[p], q);
    const Operator B = strain_operator(gradients_[p], H);
    Strain e = strain(H);
    if (tau != 0) e += tau * (B * v);
    f += volume_[p] * B.transpose() * (D_ * e);
  }
  return f;
}

template <int Nodes>
typename Triangle2d<Nodes>::Square Triangle2d<Nodes>::tangent(const Coordinates& q,
                                                              double stiffness,
                                                              double damping) const {
  Square K = Square::Zero();
  for (std::size_t p = 0; p < static_cast<std::size_t>(kPoints); ++p) {
    const Eigen::Matrix2d H = displacement_gradient(gradients_[p], q);
    const Operator B = strain_operator(gradients_[p], H);
    const Strain s = D_ * strain(H);
    K += (stiffness + damping) * volume_[p] * B.transpose() * D_ * B;
    Eigen::Matrix2d S;
    S << s[0], s[2], s[2], s[1];
    const Eigen::Matrix<double, Nodes, Nodes> geometric =
        stiffness * volume_[p] * gradients_[p].transpose() * S * gradients_[p];
    for (int a = 0; a < Nodes; ++a) {
      for (int b = 0; b < Nodes; ++b) {
        K(2 * a, 2 * b) += geometric(a, b);
        K(2 * a + 1, 2 * b + 1) += geometric(a, b);
      }
    }
  }
  return K;
}

template <int Nodes>
typename Triangle2d<Nodes>::Coordinates Triangle2d<Nodes>::discrete_gradient_forces(
    const Coordinates& q0, const Coordinates& q1, double rate) const {
  Coordinates f = Coordinates::Zero();
  for (std::size_t p = 0; p < static_cast<std::size_t>(kPoints); ++p) {
    const Eigen::Matrix2d H0 = displacement_gradient(gradients_[p], q0);
    const Eigen::Matrix2d H1 = displacement_gradient(gradients_[p], q1);
    const Strain e0 = strain(H0), e1 = strain(H1);
    const Operator B = strain_operator(gradients_[p], (H0 + H1) / 2);
    f += volume_[p] * B.transpose() * (D_ * ((e0 + e1) / 2 + rate * (e1 - e0)));
  }
  return f;
}

template <int Nodes>
typename Triangle2d<Nodes>::Square Triangle2d<Nodes>::mass() const {
  return mass_;
}

template <int Nodes>
Eigen::Vector3d Triangle2d<Nodes>::stress(const Coordinates& q) const {
  Strain mean = Strain::Zero();
  for (const Gradients& gradients : gradients_)
    mean += strain(displacement_gradient(gradients, q)) / kPoints;
  return D_ * mean;
}

template struct Triangle2d<3>;
template struct Triangle2d<6>;

}  // namespace trammel::solver::large_motion
