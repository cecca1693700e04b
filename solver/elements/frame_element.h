#pragma once

#include <Eigen/Core>
#include <type_traits>

#include "solver/model/dual.h"
#include "solver/model/model.h"

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
                            const std::type_identity_t<T>& length);

/// B of the element along `direction` (unit vector, world axes): world dofs -> d [m, rad, rad].
template <Real T = double>
[[nodiscard]] Matrix36<T> frame_deformation_matrix(const Eigen::Vector2<T>& direction,
                                                   const std::type_identity_t<T>& length);

/// Diagonal stiffness of the three deformations [N/m, N m, N m].
template <Real T>
[[nodiscard]] Eigen::Vector3<T> frame_rigidity(const SectionOf<T>& section, BeamTheory theory,
                                               const std::type_identity_t<T>& length);

/// Stiffness in element axes.
/// @param length  L > 0 [m].   Source: paper Eq. (7); Przemieniecki (1968) with shear.
[[nodiscard]] Matrix6d frame_stiffness(const Section& section, BeamTheory theory, double length);

/// Rows (axial displacement, transverse displacement, rotation of the section) at the fraction
/// 0 <= xi <= 1 of the length, for each dof in element axes. Source: Friedman & Kosmatka (1993).
template <Real T>
[[nodiscard]] Matrix36<T> frame_interpolation(const T& shear_ratio,
                                              const std::type_identity_t<T>& length, double xi);

/// Mass in element axes. Consistent: integral of rho A (u^2 + v^2) and, with rotary inertia, rho I
/// θ^2 over the interpolation. Lumped: half of each at either node, so that rotations carry none
/// without rotary inertia.   Source: paper Eq. (6, 7); Friedman & Kosmatka (1993).
template <Real T>
[[nodiscard]] Matrix6<T> frame_mass(const SectionOf<T>& section, BeamTheory theory, MassMatrix mass,
                                    const std::type_identity_t<T>& length);

/// Mass of a bar that does not bend (E I = 0), linear in both directions; rotations carry none.
[[nodiscard]] Matrix6d bar_mass(const Section& section, MassMatrix mass, double length);

/// Nodal forces of a uniform load (qx, qy) [N/m] in element axes; the same for all theories.
[[nodiscard]] Vector6d frame_uniform_load(const Vector2d& load, double length);

/// T_s: world dofs -> element dofs.   Source: paper Eq. (10).
template <Real T = double>
[[nodiscard]] Matrix6<T> frame_rotation(const Eigen::Vector2<T>& direction);

}  // namespace trammel::solver
