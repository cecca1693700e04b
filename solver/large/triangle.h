#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/large/constrained_system.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Total-Lagrangian membrane triangle of a St. Venant-Kirchhoff material in plane stress, with 3 or
/// 6 nodes (mid-side nodes on the sides 01, 12, 20):
///
///   \f[ E = (H + H^T + H^T H)/2, \quad H = du/dX, \quad S = D E, \quad
///       U = t A \sum w\, E : S/2. \f]
///
/// t is the thickness, A the area, w are the weights of the integration points, and D is the
/// elasticity matrix. The coordinates are (ux, uy) of each node [m].
template <int Nodes>
class Triangle2d : public ElementSizes<2 * Nodes, 0> {
  static_assert(Nodes == 3 || Nodes == 6);

 public:
  using typename ElementSizes<2 * Nodes, 0>::Coordinates;
  using typename ElementSizes<2 * Nodes, 0>::Square;

  /// Computes the integration points and the mass matrix.
  /// @throws ModelError  if the triangle has no area.
  Triangle2d(const Model& model, const Triangle& triangle);

  [[nodiscard]] double energy(const Coordinates& q) const;
  /// Returns the nodal forces dEnergy/dq with strain-rate damping, S = D (E + tau dE/dt).
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const;
  /// Returns `stiffness_factor` K + `damping` K_m. K is the derivative of `forces` with v = 0, and
  /// K_m is K without the geometric stiffness. `damping` includes the factor tau.
  [[nodiscard]] Square tangent(const Coordinates& q, double stiffness_factor, double damping) const;
  /// Returns forces f with f . (q1 - q0) = energy(q1) - energy(q0) if tau = 0 (J. C. Simo, N.
  /// Tarnow, ZAMP 43, 1992). `damping_over_step` is the damping coefficient tau divided by the time
  /// step.
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double damping_over_step) const;
  [[nodiscard]] const Square& mass() const { return mass_; }

 private:
  using Gradients = Eigen::Matrix<double, 2, Nodes>;
  using Strain = Eigen::Vector3d;  ///< E11, E22, 2 E12
  using Operator = Eigen::Matrix<double, 3, 2 * Nodes>;

  /// Integration point of the triangle.
  struct Point {
    Gradients gradients;
    double volume = 0;  ///< thickness times area times weight [m^3]

    [[nodiscard]] Eigen::Matrix2d displacement_gradient(const Coordinates& q) const;
    [[nodiscard]] Operator strain_displacement_matrix(const Eigen::Matrix2d& H) const;
  };

  [[nodiscard]] static Strain strain(const Eigen::Matrix2d& H);

  Eigen::Matrix3d D_;
  std::array<Point, Nodes == 3 ? 1 : 3> points_;
  Square mass_;
};

}  // namespace trammel::solver::large_motion
