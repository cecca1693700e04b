#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/model/quadrature.h"

/// The two-node planar frame element, as pure functions. Element axes: x from the first node to the
/// second, y to its left; dofs (u1 v1 θ1 u2 v2 θ2) [m, m, rad].
///
/// All beam theories share one interpolation, exact for a prismatic beam loaded at its ends, with
/// Phi = 12 EI / (kappa GA L^2) (Przemieniecki 1968; Friedman & Kosmatka 1993); Phi = 0 gives the
/// Hermite cubics of Euler-Bernoulli and Rayleigh. It cannot lock in shear.
///
/// The stiffness is written in the three motions that deform the element, d = B u:
///   elongation u2 - u1, symmetric bending θ2 - θ1, antisymmetric bending θ1 + θ2 - 2 (v2 - v1) /
///   L,
/// in which it is diagonal: k = B^T diag(EA/L, EI/L, 3 EI / (L (1 + Phi))) B. Energies and forces
/// taken from d keep the digits of bending beside a much stiffer axial part; the entries of k in
/// world axes do not.
///
/// Functions of T exist for double and Dual.
namespace trammel::solver {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
template <class T>
using Matrix6 = Eigen::Matrix<T, 6, 6>;
template <class T>
using Matrix36 = Eigen::Matrix<T, 3, 6>;
using FrameDeformation = Matrix36<double>;

/// Section of a member at the fraction 0 <= at <= 1 of its length, by its taper.
[[nodiscard]] Section section_at(const Member& member, double at);

/// Phi = 12 EI / (kappa GA L^2) [-]; 0 for a theory without shear.
template <Real T>
[[nodiscard]] T shear_ratio(const SectionOf<T>& section, BeamTheory theory,
                            const std::type_identity_t<T>& length) {
  if (!has_shear_deformation(theory)) return T(0);
  return 12.0 * section.EI / (section.kappa_GA * length * length);
}

/// B of the element along `direction` (unit vector, world axes): world dofs -> d [m, rad, rad].
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

/// Diagonal stiffness of the three deformations [N/m, N m, N m].
template <Real T>
[[nodiscard]] Eigen::Vector3<T> frame_rigidity(const SectionOf<T>& section, BeamTheory theory,
                                               const std::type_identity_t<T>& length) {
  const T phi = shear_ratio(section, theory, length);
  return {section.EA / length, section.EI / length, 3.0 * section.EI / (length * (1.0 + phi))};
}

/// Stiffness in element axes.
/// @param length  L > 0 [m].   Source: paper Eq. (7); Przemieniecki (1968) with shear.
[[nodiscard]] Matrix6d frame_stiffness(const Section& section, BeamTheory theory, double length);

/// Rows (axial displacement, transverse displacement, rotation of the section) at the fraction
/// 0 <= xi <= 1 of the length, for each dof in element axes. Source: Friedman & Kosmatka (1993).
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

/// Mass in element axes. Consistent: integral of rho A (u^2 + v^2) and, with rotary inertia, rho I
/// θ^2 over the interpolation. Lumped: half of each at either node, so that rotations carry none
/// without rotary inertia.   Source: paper Eq. (6, 7); Friedman & Kosmatka (1993).
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

/// Mass of a bar that does not bend (E I = 0), linear in both directions; rotations carry none.
[[nodiscard]] Matrix6d bar_mass(const Section& section, MassMatrix mass, double length);

/// Nodal forces of a uniform load (qx, qy) [N/m] in element axes; the same for all theories.
[[nodiscard]] Vector6d frame_uniform_load(const Vector2d& load, double length);

/// T_s: world dofs -> element dofs.   Source: paper Eq. (10).
template <Real T = double>
[[nodiscard]] Matrix6<T> frame_rotation(const Eigen::Vector2<T>& direction) {
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
