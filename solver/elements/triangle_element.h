#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/elements/frame_element.h"
#include "solver/model/model.h"

/// The constant-strain triangle in plane stress, as pure functions. Dofs (u1 v1 u2 v2 u3 v3) in
/// world axes [m].
///
/// As for the frame element, the stiffness is diagonal in the right measures of deformation,
/// d = B u = (exx + eyy, exx - eyy, gxy): k = B^T diag(t A E / (2 (1 - nu)), t A G, t A G) B,
/// which is the paper's k = t integral B^T D B dA, Eq. (8).
namespace trammel::solver {

using TrianglePoints = std::array<Vector2d, 3>;
using TriangleDeformation = Eigen::Matrix<double, 3, 6>;

[[nodiscard]] TrianglePoints corners(const Model& model, const Triangle& triangle);

/// Area [m^2], positive when the points run counterclockwise.
[[nodiscard]] double signed_area(const TrianglePoints& points);

/// B: dofs -> (exx + eyy, exx - eyy, gxy) [-].
[[nodiscard]] TriangleDeformation triangle_deformation(const TrianglePoints& points);

/// Diagonal stiffness of the three deformations over a volume [m^3] of plate: [N m].
[[nodiscard]] Vector3d membrane_rigidity(const Material& material, double volume);

/// (sxx, syy, sxy) [Pa] of the three deformations in plane stress.   Source: paper Eq. (8).
[[nodiscard]] Vector3d membrane_stress(const Material& material, const Vector3d& deformation);

/// Source: paper Eq. (8).
[[nodiscard]] Matrix6d triangle_stiffness(const TrianglePoints& points, const Plate& plate);

/// Consistent mass, m = rho t integral N^T N dA.   Source: paper Eq. (9).
[[nodiscard]] Matrix6d triangle_mass(const TrianglePoints& points, const Plate& plate);

}  // namespace trammel::solver
