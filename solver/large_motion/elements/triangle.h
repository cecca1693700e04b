#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <array>

#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Total-Lagrangian membrane triangle of a St. Venant-Kirchhoff material in plane stress, with 3 or
/// 6 nodes (mid-sides 01, 12, 20) [m]: E = (H + H^T + H^T H)/2, H = du/dX, S = D E,
/// energy = t A sum of w E:S/2.
template <int Nodes>
struct Triangle2d {
  static_assert(Nodes == 3 || Nodes == 6);
  static constexpr int N = 2 * Nodes;
  static constexpr int kPoints = Nodes == 3 ? 1 : 3;
  using Coordinates = Eigen::Matrix<double, N, 1>;
  using Square = Eigen::Matrix<double, N, N>;
  using Gradients = Eigen::Matrix<double, 2, Nodes>;

  /// @throws ModelError  where the triangle has no area.
  Triangle2d(const Material& material, double thickness,
             const std::array<Eigen::Vector2d, Nodes>& corners);

  [[nodiscard]] double energy(const Coordinates& q) const;
  /// dEnergy/dq plus strain-rate damping, S = D (E + tau dE/dt).
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const;
  /// stiffness K + damping tau K_material: the derivative of `forces` with v = 0.
  [[nodiscard]] Square tangent(const Coordinates& q, double stiffness, double damping) const;
  /// Forces f with f . (q1 - q0) = energy(q1) - energy(q0) where tau = 0 (J. C. Simo,
  /// N. Tarnow, ZAMP 43, 1992); `rate` is tau over the step.
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double rate) const;
  [[nodiscard]] Square mass() const;
  [[nodiscard]] Eigen::Vector3d stress(const Coordinates& q) const;

 private:
  using Strain = Eigen::Vector3d;  ///< E11, E22, 2 E12
  using Operator = Eigen::Matrix<double, 3, N>;

  [[nodiscard]] static Eigen::Matrix2d displacement_gradient(const Gradients& gradients,
                                                             const Coordinates& q);
  [[nodiscard]] static Strain strain(const Eigen::Matrix2d& H);
  [[nodiscard]] static Operator strain_operator(const Gradients& gradients,
                                                const Eigen::Matrix2d& H);

  Eigen::Matrix3d D_;
  std::array<Gradients, kPoints> gradients_;
  std::array<double, kPoints> volume_{};  ///< thickness times area times weight [m^3]
  Square mass_;
};

}  // namespace trammel::solver::large_motion
