#pragma once

#include <Eigen/Core>

namespace trammel::solver {

/// Shape functions of a triangle at area coordinates L: L_i of three nodes; of six L_i (2 L_i - 1)
/// at the corners, 4 L_i L_j at the middles of the sides 01, 12, 20. What stands beyond is 0.
/// Source: Zienkiewicz & Taylor, The Finite Element Method, vol. 1.
[[nodiscard]] inline Eigen::Matrix<double, 6, 1> triangle_shape_functions(const Eigen::Vector3d& L,
                                                                          bool six_nodes) {
  Eigen::Matrix<double, 6, 1> N = Eigen::Matrix<double, 6, 1>::Zero();
  if (six_nodes) {
    N << L[0] * (2 * L[0] - 1), L[1] * (2 * L[1] - 1), L[2] * (2 * L[2] - 1), 4 * L[0] * L[1],
        4 * L[1] * L[2], 4 * L[2] * L[0];
  } else {
    N.head<3>() = L;
  }
  return N;
}

}  // namespace trammel::solver
