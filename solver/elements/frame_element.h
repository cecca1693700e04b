#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/model/quadrature.h"

/// Two-node planar frame element, as pure functions. The element x axis points from the first node
/// to the second. The element y axis is the x axis, rotated counterclockwise by 90 degrees. The
/// degrees of freedom are (u1 v1 θ1 u2 v2 θ2) [m, m, rad].
///
/// All beam theories share one interpolation, which is exact for a prismatic beam loaded at its
/// ends (Przemieniecki 1968; Friedman & Kosmatka 1993). The interpolation depends on the shear
/// ratio
///
///   \f[ \Phi = 12 EI / (\kappa GA L^2). \f]
///
/// Phi = 0 gives the Hermite cubics of the Euler-Bernoulli and Rayleigh theories. The element does
/// not lock in shear.
///
/// The stiffness is diagonal in three measures of deformation, d = B u:
///
///   elongation              u2 - u1,
///   symmetric bending       θ2 - θ1,
///   antisymmetric bending   θ1 + θ2 - 2 (v2 - v1) / L,
///   \f[ k = B^T \operatorname{diag}(EA/L,\ EI/L,\ 3 EI / (L (1 + \Phi)))\, B. \f]
///
/// Energies and forces computed from d keep the significant digits of bending even if the axial
/// stiffness is much larger. The entries of k in world axes lose these digits.
///
/// The type T of the function templates is double or Dual (dual number for derivatives).
namespace trammel::solver {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
template <class T>
using Matrix6 = Eigen::Matrix<T, 6, 6>;
template <class T>
using Matrix36 = Eigen::Matrix<T, 3, 6>;
using FrameDeformation = Matrix36<double>;

/// Returns the section of a member at the fraction 0 <= at <= 1 of the member length, according to
/// the taper of the member.
[[nodiscard]] Section section_at(const Member& member, double at);

/// Returns the shear ratio Phi = 12 EI / (kappa GA L^2) [-], or 0 for a beam theory without shear
/// deformation.
template <Real T>
[[nodiscard]] T shear_ratio(const SectionOf<T>& section, BeamTheory theory,
                            const std::type_identity_t<T>& length) {
  if (!has_shear_deformation(theory)) return T(0);
  return 12.0 * section.EI / (section.kappa_GA * length * length);
}

/// Returns the deformation matrix B, 3 x 6, of an element along `direction` (unit vector, world
/// axes). B maps degrees of freedom in world axes to the elongation, the symmetric bending and the
/// antisymmetric bending of the element [m, rad, rad].
template <Real T = double>
[[nodiscard]] Matrix36<T> frame_deformation_matrix(const Eigen::Vector2<T>& direction,
                                                   const std::type_identity_t<T>& length) {
  const T c = direction.x();
  const T s = direction.y();
  const T rs = 2.0 / length * s;
  const T rc = 2.0 / length * c;
  Matrix36<T> B = Matrix36<T>::Zero();
  B(0, 3) = c;
  B(0, 4) = s;
  B(0, 0) = -c;
  B(0, 1) = -s;
  B(1, 2) = -1;
  B(1, 5) = 1;
  B(2, 0) = -rs;
  B(2, 1) = rc;
  B(2, 3) = rs;
  B(2, 4) = -rc;
  B(2, 2) = B(2, 5) = 1;
  return B;
}

/// Returns the stiffnesses of the three deformations of an element: elongation [N/m], symmetric and
/// antisymmetric bending [N m].
template <Real T>
[[nodiscard]] Eigen::Vector3<T> frame_deformation_stiffness(const SectionOf<T>& section,
                                                            BeamTheory theory,
                                                            const std::type_identity_t<T>& length) {
  const T phi = shear_ratio(section, theory, length);
  return {section.EA / length, section.EI / length, 3.0 * section.EI / (length * (1.0 + phi))};
}

/// Returns the interpolation matrix at the fraction 0 <= xi <= 1 of the element length, 3 x 6. The
/// rows are the axial displacement, the transverse displacement and the rotation of the section.
/// The columns are the degrees of freedom in element axes.
/// Source: Friedman & Kosmatka (1993).
template <Real T>
[[nodiscard]] Matrix36<T> frame_interpolation(const T& shear_ratio,
                                              const std::type_identity_t<T>& length, double xi) {
  const double x2 = xi * xi;
  const double x3 = x2 * xi;
  const T phi = shear_ratio;
  const T g = 1.0 / (1.0 + phi);
  const T h = 0.5 * phi * (xi - x2);
  Matrix36<T> N = Matrix36<T>::Zero();
  N(0, 0) = 1 - xi;
  N(0, 3) = xi;
  N(1, 1) = g * (1 - 3 * x2 + 2 * x3 + phi * (1 - xi));
  N(1, 2) = g * length * (xi - 2 * x2 + x3 + h);
  N(1, 4) = g * (3 * x2 - 2 * x3 + phi * xi);
  N(1, 5) = g * length * (x3 - x2 - h);
  N(2, 1) = g * 6.0 * (x2 - xi) / length;
  N(2, 2) = g * (1 - 4 * xi + 3 * x2 + phi * (1 - xi));
  N(2, 4) = -N(2, 1);
  N(2, 5) = g * (3 * x2 - 2 * xi + phi * xi);
  return N;
}

/// Returns the mass matrix of an element in element axes, 6 x 6. The consistent matrix follows from
/// the integral of rho A (u^2 + v^2) over the interpolation. For a beam theory with rotary inertia,
/// rho I θ^2 is added to the integrand. The lumped matrix assigns half of the mass and of the
/// rotary inertia to each node. For a theory without rotary inertia, the lumped matrix has no mass
/// for the rotations.
/// Source: Varalakshmi & Srinivas (2017), Eq. 6, 7; Friedman & Kosmatka (1993).
template <Real T>
[[nodiscard]] Matrix6<T> frame_mass(const SectionOf<T>& section, BeamTheory theory, MassMatrix mass,
                                    const std::type_identity_t<T>& length) {
  const T m = section.mass_per_length * length;
  const T J = has_rotary_inertia(theory) ? T(section.inertia_per_length * length) : T(0);
  Matrix6<T> M = Matrix6<T>::Zero();
  if (mass == MassMatrix::lumped) {
    M.diagonal() << m / 2.0, m / 2.0, J / 2.0, m / 2.0, m / 2.0, J / 2.0;
    return M;
  }
  const T phi = shear_ratio(section, theory, length);
  for (const LineQuadraturePoint& point : line_quadrature()) {
    const Matrix36<T> N = frame_interpolation(phi, length, point.xi);
    const Eigen::Vector3<T> rho = point.weight * Eigen::Vector3<T>(m, m, J);
    M += N.transpose() * rho.asDiagonal() * N;
  }
  return (M + M.transpose().eval()) * T(0.5);
}

/// Returns the mass matrix of a bar that does not bend (E I = 0), 6 x 6. In the consistent matrix,
/// the axial and the transverse displacement vary linearly along the bar. The lumped matrix assigns
/// half of the mass to each node. Rotations are massless.
[[nodiscard]] Matrix6d bar_mass(const Section& section, MassMatrix mass, double length);

/// Returns the consistent nodal forces [N, N, N m] of a uniform load (qx, qy) [N/m] in element
/// axes. The forces are the same for all beam theories.
[[nodiscard]] Vector6d frame_uniform_load(const Vector2d& load, double length);

/// Returns the transformation matrix T_s, 6 x 6. T_s maps degrees of freedom in world axes to
/// degrees of freedom in element axes.
/// Source: Varalakshmi & Srinivas (2017), Eq. 10.
template <Real T = double>
[[nodiscard]] Matrix6<T> frame_transformation_matrix(const Eigen::Vector2<T>& direction) {
  Matrix6<T> R = Matrix6<T>::Zero();
  for (const Index node : {Index{0}, Index{3}}) {
    R(node, node) = R(node + 1, node + 1) = direction.x();
    R(node, node + 1) = direction.y();
    R(node + 1, node) = -direction.y();
    R(node + 2, node + 2) = 1;
  }
  return R;
}

}  // namespace trammel::solver
