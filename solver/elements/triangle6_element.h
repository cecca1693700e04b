#pragma once

#include <Eigen/Core>
#include <array>

#include "solver/model/model.h"
#include "solver/model/quadrature.h"

/// The six-node, isoparametric triangle in plane stress. Dofs (u1 v1 ... u6 v6) in world axes [m];
/// corners first, then the middles of the sides 12, 23, 31, which may lie off the straight line.
///
/// As for the other elements the stiffness is diagonal in measures of deformation, here those of
/// triangle_element.h at each point of a rule that is exact to degree 4: d = B u, k = B^T C B. The
/// strains are linear, so that the rule is exact for straight sides and has room for curved ones.
namespace trammel::solver {

using Matrix12d = Eigen::Matrix<double, 12, 12>;

struct Triangle6Stiffness {
  Eigen::Matrix<double, 18, 12> deformation;  ///< B: (exx + eyy, exx - eyy, gxy) at six points [-]
  Eigen::Matrix<double, 18, 1> rigidity;      ///< C: diagonal [N m]
};

/// The rule of the stiffness, exact to degree 4.   Source: Dunavant (1985).
[[nodiscard]] const std::array<TriangleQuadraturePoint, 6>& triangle6_quadrature();

/// Source: Zienkiewicz & Taylor; paper Eq. (8) for the material.
[[nodiscard]] Triangle6Stiffness triangle6_stiffness(const Model& model, const Triangle& triangle);

/// Consistent mass, rho t integral N^T N dA, exact for curved sides as well (degree 6).
[[nodiscard]] Matrix12d triangle6_mass(const Model& model, const Triangle& triangle);

/// (exx + eyy, exx - eyy, gxy) of the dofs at a point.
/// @param at  area coordinates of the corners, sum 1
[[nodiscard]] Eigen::Matrix<double, 3, 12> triangle6_deformation_matrix(const Model& model,
                                                                        const Triangle& triangle,
                                                                        const Eigen::Vector3d& at);

}  // namespace trammel::solver
