#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

/// Lagrange polynomials of degree P on the Lobatto points of [-1, 1] and their integrals.
namespace trammel::solver::large_motion {

template <int P>
struct ShapeFunctions {
  static_assert(P >= 1 && P <= 3);
  std::array<double, P + 1> node;                 ///< Lobatto points
  Eigen::Matrix<double, P, 1> weight;             ///< of the P Gauss points; sum 1
  Eigen::Matrix<double, P, P + 1> value;          ///< at the Gauss points
  Eigen::Matrix<double, P, P + 1> slope;          ///< d/dx at the Gauss points, x = s / h in [0, 1]
  Eigen::Matrix<double, P + 1, 1> integral;       ///< of each polynomial over x
  Eigen::Matrix<double, P + 1, P + 1> stiffness;  ///< integral of slope_a slope_b
  Eigen::Matrix<double, P + 1, P + 1> mass;       ///< integral of value_a value_b

  ShapeFunctions();
};

/// The table of degree P.
template <int P>
const ShapeFunctions<P>& shape_functions() {
  static const ShapeFunctions<P> table;
  return table;
}

/// Coordinate of node a of an element of that degree, in [0, 1].
[[nodiscard]] double lobatto_coordinate(int degree, std::size_t a);

}  // namespace trammel::solver::large_motion
