#pragma once

#include <Eigen/Core>

namespace trammel::solver::large_motion {

/// Linear spring between two coordinates, energy = k (q2 - q1)^2/2, for `EnergyElements`.
struct CoordinateSpring {
  static constexpr int N = 2;
  using Coordinates = Eigen::Vector2d;
  using Square = Eigen::Matrix2d;
  double stiffness = 0;  ///< k [N/m or N m/rad]

  [[nodiscard]] Square matrix() const {
    return (Square() << stiffness, -stiffness, -stiffness, stiffness).finished();
  }
  [[nodiscard]] double energy(const Coordinates& q) const { return q.dot(matrix() * q) / 2; }
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const {
    return matrix() * (q + tau * v);
  }
  [[nodiscard]] Square tangent(const Coordinates&, double k, double d) const {
    return (k + d) * matrix();
  }
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double rate) const {
    return matrix() * ((q0 + q1) / 2 + rate * (q1 - q0));
  }
  [[nodiscard]] Square mass() const { return Square::Zero(); }
};

}  // namespace trammel::solver::large_motion
