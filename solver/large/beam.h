#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solver/large/constrained_system.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Returns cos(x) - 1 without cancellation error for small x.
inline double cosine_minus_one(double x) {
  const double s = std::sin(x / 2);
  return -2 * s * s;
}

/// Returns sin(x) / x, which is 1 at x = 0.
inline double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// Shape functions of the beam element: Lagrange polynomials of degree 3 through four Lobatto
/// points. The variable x in [0, 1] is the position along the element.
struct BeamInterpolation {
  static constexpr int kNodes = 4, kPoints = 3;
  std::array<double, kNodes> node{};              ///< positions x of the nodes (Lobatto points)
  Eigen::Matrix<double, kPoints, 1> weight;       ///< weights of the Gauss points; their sum is 1
  Eigen::Matrix<double, kPoints, kNodes> value;   ///< values of the polynomials at the Gauss points
  Eigen::Matrix<double, kPoints, kNodes> slope;   ///< polynomial derivatives at the Gauss points
  Eigen::Matrix<double, kNodes, 1> integral;      ///< integral of each polynomial over x
  Eigen::Matrix<double, kNodes, kNodes> bending;  ///< integrals of products of two derivatives
  Eigen::Matrix<double, kNodes, kNodes> mass;     ///< integrals of products of two polynomials
};

[[nodiscard]] const BeamInterpolation& beam_interpolation();

/// Geometrically exact beam element (Simo-Reissner) with four nodes and three Gauss points. The
/// element is straight in the unloaded state. u is the displacement, ' the derivative along the
/// element, and R the rotation of a section by theta. t0 and n0 are the axes of the unloaded
/// element, h is the element length, and w are the Gauss weights:
///
///     Gamma = R^T (t0 + u') - t0 = (stretch, shear),       kappa = theta',
///     energy = sum over Gauss points of  w h (N Gamma_1 + V Gamma_2 - N^2/2EA - V^2/2kGA)
///              + 1/2 integral of EI kappa^2.
///
/// The normal force N and the shear force V at the Gauss points are unknowns. Each force is the
/// multiplier of a constraint row g = w h Gamma with the compliance w h / EA or w h / kGA. Zero
/// compliance is therefore possible, and exactly represents an inextensible member or an
/// Euler-Bernoulli member (J. C. Simo, CMAME 49, 1985; E. Reissner, ZAMP 23, 1972). The ratios EA :
/// EI : kGA affect neither the accuracy nor the convergence of Newton's method.
///
/// If no load acts between the ends of the element, its end displacements equal those of Gauss
/// collocation of the differential equation of the rod. The error of these displacements is O(h^6),
/// there is no locking, and the limit of small displacements is exact.
///
/// The coordinates are (ux, uy, theta) of each node along the element [m, m, rad]. The constraint
/// rows g are the stretch and the shear of each Gauss point times w h [m].
struct Beam : ElementSizes<12, 6> {
  Vector2d axis = Vector2d::UnitX();  ///< t0, unit vector along the unloaded element
  double length = 1;                  ///< length h of the element [m]
  double EI = 1;                      ///< bending stiffness [N m^2]
  double stretch_compliance = 0;      ///< 1/EA [1/N]
  double shear_compliance = 0;        ///< 1/kGA [1/N]
  double mass_per_length = 0;         ///< mass per length [kg/m]
  double inertia_per_length = 0;      ///< rotary inertia per length [kg m]
  bool lumped = false;

  /// Computes the residuals g of the constraint rows [m] and their gradient G = dg/dq.
  void constraint_residual(const Coordinates& q, double t, Rows& residual, Gradient& G) const;
  /// Returns the geometric stiffness: the sum of lambda_i d^2 g_i / dq^2 over the constraint rows.
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const;
  /// Returns the discrete gradient D of the constraints g, with D (q1 - q0) = g(q1) - g(q0).
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const;

  /// Returns the nodal moments of bending [N m]. tau is the coefficient of strain-rate damping [s].
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const;
  /// Returns the bending stiffness matrix times (`stiffness_factor` + `damping`). The matrix is
  /// constant, because the curvature kappa is linear in the rotations.
  [[nodiscard]] Square tangent(const Coordinates& q, double stiffness_factor, double damping) const;
  /// Returns the mean nodal moments of bending in a time step from q0 to q1. `damping_over_step` is
  /// the damping coefficient tau divided by the time step.
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double damping_over_step) const {
    return forces((q0 + q1) / 2, q1 - q0, damping_over_step);
  }
  /// Returns the strain energy of bending [J].
  [[nodiscard]] double energy(const Coordinates& q) const;
  [[nodiscard]] Square mass() const;
  /// Returns the nodal forces of a distributed load [N/m].
  [[nodiscard]] Coordinates distributed_load(const Vector2d& force_per_length) const;
  /// Returns the compliance of each constraint row: w h / EA (stretch) or w h / kGA (shear). w is
  /// the Gauss weight, and h the element length.
  [[nodiscard]] Rows row_compliance() const;
  /// Returns the penalties rho of the constraint rows (see `KktMatrix`). The stiffness term of rho
  /// is a shear stiffness 12 EI/h^2, which is comparable with the bending stiffness. The mass term
  /// of rho is the mass of the element.
  [[nodiscard]] Rows row_penalty(const TangentCoefficients& coefficients) const;
  /// Returns the unit normal of the cross section at a node: the axis t0 of the unloaded element,
  /// rotated by the rotation of the node.
  [[nodiscard]] Vector2d section_normal(const Coordinates& q, int node) const {
    return rotated(axis, q[3 * node + 2]);
  }
};

}  // namespace trammel::solver::large_motion
