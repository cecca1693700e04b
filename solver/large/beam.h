#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solver/large/constrained_system.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Returns cos(x) - 1 without cancellation.
inline double cosine_minus_one(double x) {
  const double s = std::sin(x / 2);
  return -2 * s * s;
}

/// Returns sin(x) / x.
inline double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// Lagrange polynomials of degree 3 on the Lobatto points of an element, over x = s/h in [0, 1],
/// and their integrals.
struct BeamInterpolation {
  static constexpr int kNodes = 4, kPoints = 3;
  std::array<double, kNodes> node{};              ///< Lobatto points
  Eigen::Matrix<double, kPoints, 1> weight;       ///< of the Gauss points; their sum is 1
  Eigen::Matrix<double, kPoints, kNodes> value;   ///< at the Gauss points
  Eigen::Matrix<double, kPoints, kNodes> slope;   ///< d/dx at the Gauss points
  Eigen::Matrix<double, kNodes, 1> integral;      ///< integral of each polynomial
  Eigen::Matrix<double, kNodes, kNodes> bending;  ///< integral of slope_a slope_b
  Eigen::Matrix<double, kNodes, kNodes> mass;     ///< integral of value_a value_b
};

/// Returns the polynomials and integrals.
[[nodiscard]] const BeamInterpolation& beam_interpolation();

/// Geometrically exact beam element (Simo-Reissner) with four nodes and three Gauss points,
/// straight without load. With the element axes t0, n0 and the rotation R(theta) of the section:
///
///     Gamma = R^T (t0 + u') - t0 = (stretch, shear),       kappa = theta',
///
///     energy = sum over Gauss points of  w h (N Gamma_1 + V Gamma_2 - N^2/2EA - V^2/2kGA)
///
///              + 1/2 integral of EI kappa^2.
///
/// N and V at the Gauss points are unknowns. Each is the multiplier of a row g = w h Gamma with
/// compliance w h / EA or w h / kGA. Zero compliance is therefore exact: an inextensible member, or
/// an Euler-Bernoulli member (J. C. Simo, CMAME 49, 1985; E. Reissner, ZAMP 23, 1972). The ratios
/// EA : EI : kGA affect neither the accuracy nor the convergence of Newton's method.
///
/// Without a load inside the element, its end nodes are those of Gauss collocation of the
/// differential equation of the rod. The error is O(h^6), there is no locking, and the linear limit
/// is exact.
///
/// Coordinates are (ux, uy, theta) of each node along the element [m, m, rad]. Rows are stretch and
/// shear of each Gauss point [m].
struct Beam : ElementSizes<12, 6> {
  Vector2d axis = Vector2d::UnitX();  ///< t0
  double length = 1;                  ///< h [m]
  double EI = 1;                      ///< [N m^2]
  double stretch_compliance = 0;      ///< 1/EA [1/N]
  double shear_compliance = 0;        ///< 1/kGA [1/N]
  double mass_per_length = 0;         ///< [kg/m]
  double inertia_per_length = 0;      ///< [kg m]
  bool lumped = false;

  /// Computes g [m] and its gradient G.
  void constraint_residual(const Coordinates& q, double t, Rows& residual, Gradient& G) const;
  /// Returns the sum of lambda_i d^2 g_i / dq^2.
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const;
  /// Returns D with D (q1 - q0) = g(q1) - g(q0).
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const;

  /// Returns the bending moments at the nodes [N m] with strain-rate damping tau [s].
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const;
  /// Returns stiffness and damping of bending. They are constant because kappa is linear in the
  /// rotations.
  [[nodiscard]] Square tangent(const Coordinates& q, double stiffness, double damping) const;
  /// Returns the mean bending moments of a step, with `rate` = tau over the step.
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double rate) const {
    return forces((q0 + q1) / 2, q1 - q0, rate);
  }
  /// Returns the strain energy of bending [J].
  [[nodiscard]] double energy(const Coordinates& q) const;
  [[nodiscard]] Square mass() const;
  /// Returns the nodal forces of a distributed load [N/m].
  [[nodiscard]] Coordinates distributed_load(const Vector2d& force_per_length) const;
  [[nodiscard]] Rows compliance() const;
  /// Returns rho of `KktMatrix`. It consists of a shear stiffness 12 EI/h^2, which makes bending
  /// and shear comparable, and the mass of the element.
  [[nodiscard]] Rows penalty(const TangentCoefficients& coefficients) const;
  /// Returns the axis of the section at a node.
  [[nodiscard]] Vector2d section_axis(const Coordinates& q, int node) const {
    return rotated(axis, q[3 * node + 2]);
  }
};

}  // namespace trammel::solver::large_motion
