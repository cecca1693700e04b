#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solver/large/constrained_system.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// cos(x) - 1 without cancellation.
inline double cosine_minus_one(double x) {
  const double s = std::sin(x / 2);
  return -2 * s * s;
}

/// sin(x) / x.
inline double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// Lagrange polynomials of degree 3 on the Lobatto points of an element, over x = s/h in [0, 1],
/// and their integrals.
struct BeamInterpolation {
  static constexpr int kNodes = 4, kPoints = 3;
  std::array<double, kNodes> node{};              ///< Lobatto points
  Eigen::Matrix<double, kPoints, 1> weight;       ///< of the Gauss points; sum 1
  Eigen::Matrix<double, kPoints, kNodes> value;   ///< at the Gauss points
  Eigen::Matrix<double, kPoints, kNodes> slope;   ///< d/dx at the Gauss points
  Eigen::Matrix<double, kNodes, 1> integral;      ///< of each polynomial
  Eigen::Matrix<double, kNodes, kNodes> bending;  ///< integral of slope_a slope_b
  Eigen::Matrix<double, kNodes, kNodes> mass;     ///< integral of value_a value_b
};

[[nodiscard]] const BeamInterpolation& beam_interpolation();

/// Geometrically exact beam element (Simo-Reissner) with four nodes and three Gauss points,
/// straight when unloaded. With t0, n0 the element's axes and R(theta) the rotation of the section,
///
///     Gamma = R^T (t0 + u') - t0 = (stretch, shear),       kappa = theta',
///     energy = sum over Gauss points of  w h (N Gamma_1 + V Gamma_2 - N^2/2EA - V^2/2kGA)
///              + 1/2 integral of EI kappa^2.
///
/// N and V at the Gauss points are unknowns: each is the multiplier of a row g = w h Gamma of
/// compliance w h / EA or w h / kGA. Zero compliance is then exact: an inextensible member, an
/// Euler-Bernoulli member (J. C. Simo, CMAME 49, 1985; E. Reissner, ZAMP 23, 1972), and neither
/// ratio EA : EI : kGA enters the digits or Newton's path. Without a load inside, end nodes are
/// those of Gauss collocation of the rod's differential equation: error O(h^6), no locking, and
/// exact in the linear limit.
///
/// Coordinates: (ux, uy, theta) of each node along the element [m, m, rad]. Rows: stretch, shear
/// of each Gauss point [m].
struct Beam : ElementSizes<12, 6> {
  Vector2d axis = Vector2d::UnitX();  ///< t0
  double length = 1;                  ///< h [m]
  double EI = 1;                      ///< [N m^2]
  double stretch_compliance = 0;      ///< 1/EA [1/N]
  double shear_compliance = 0;        ///< 1/kGA [1/N]
  double mass_per_length = 0;         ///< [kg/m]
  double inertia_per_length = 0;      ///< [kg m]
  bool lumped = false;

  void constraint_residual(const Coordinates& q, double t, Rows& residual, Gradient& G) const;
  /// sum of lambda_i d^2 g_i / dq^2.
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const;
  /// D with D (q1 - q0) = g(q1) - g(q0).
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const;

  /// Moments of bending at the nodes with strain-rate damping tau.
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const;
  /// Stiffness and damping of bending, constant because kappa is linear in the rotations.
  [[nodiscard]] Square tangent(const Coordinates& q, double stiffness, double damping) const;
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double rate) const {
    return forces((q0 + q1) / 2, q1 - q0, rate);
  }
  /// Strain energy of bending [J].
  [[nodiscard]] double energy(const Coordinates& q) const;
  [[nodiscard]] Square mass() const;
  /// Forces at the nodes of a distributed load [N/m].
  [[nodiscard]] Coordinates distributed_load(const Vector2d& force_per_length) const;
  [[nodiscard]] Rows compliance() const;
  /// rho of `KktMatrix`: a shear stiffness 12 EI/h^2, which keeps bending and shear of one size,
  /// and the element's mass.
  [[nodiscard]] Rows penalty(const TangentCoefficients& coefficients) const;
  /// Axis of the section at a node.
  [[nodiscard]] Vector2d section_axis(const Coordinates& q, int node) const {
    return rotated(axis, q[3 * node + 2]);
  }
};

}  // namespace trammel::solver::large_motion
