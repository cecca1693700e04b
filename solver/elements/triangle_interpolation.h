#pragma once

#include <Eigen/Core>

#include "solver/model/model.h"

namespace trammel::solver {

/// The shape functions of a three- or six-node triangle at one point. The six-node one is
/// isoparametric: N_i = L_i (2 L_i - 1) at the corners, 4 L_i L_j at the middles of the sides 01,
/// 12, 20, so that its sides may be curved.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1.
struct TriangleInterpolation {
  Index nodes = 3;                       ///< 3 or 6; what stands beyond is 0
  Eigen::Matrix<double, 6, 1> N;         ///< values [-]
  Eigen::Matrix<double, 2, 6> gradient;  ///< dN/dx, dN/dy [1/m]
  Vector2d position = Vector2d::Zero();  ///< world [m]
  double signed_area = 0;  ///< [m^2], positive when the corners run counterclockwise here
  double area = 0;         ///< the triangle's area if all of it were like here [m^2]
};

/// @param at  area coordinates L_0, L_1, L_2 of the corners, sum 1
[[nodiscard]] TriangleInterpolation interpolate(const Model& model, const Triangle& triangle,
                                                const Eigen::Vector3d& at);

}  // namespace trammel::solver
