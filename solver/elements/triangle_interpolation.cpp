#include "solver/elements/triangle_interpolation.h"

#include <Eigen/LU>
#include <cmath>

#include "solver/model/triangle_shape.h"

namespace trammel::solver {
namespace {

/// Derivatives with respect to L_0 and L_1, with L_2 = 1 - L_0 - L_1.
Eigen::Matrix<double, 2, 6> local_gradient(bool quadratic, const Eigen::Vector3d& L) {
  Eigen::Matrix<double, 2, 6> d = Eigen::Matrix<double, 2, 6>::Zero();
  if (!quadratic) {
    d.leftCols<3>() << 1, 0, -1, 0, 1, -1;
    return d;
  }
  d << 4 * L[0] - 1, 0, 1 - 4 * L[2], 4 * L[1], -4 * L[1], 4 * (L[2] - L[0]),  //
      0, 4 * L[1] - 1, 1 - 4 * L[2], 4 * L[0], 4 * (L[2] - L[1]), -4 * L[0];
  return d;
}

}  // namespace

TriangleInterpolation interpolate(const Model& model, const Triangle& triangle,
                                  const Eigen::Vector3d& at) {
  const bool quadratic = triangle.quadratic();
  TriangleInterpolation result;
  result.nodes = quadratic ? 6 : 3;
  result.N = triangle_shape_functions(at, quadratic);
  const Eigen::Matrix<double, 2, 6> local = local_gradient(quadratic, at);
  Eigen::Matrix2d J = Eigen::Matrix2d::Zero();  // d(x, y) / d(L_0, L_1), by rows of L
  for (Index i = 0; i < result.nodes; ++i) {
    const auto node = static_cast<std::size_t>(triangle.nodes[static_cast<std::size_t>(i)]);
    const Vector2d& p = model.nodes[node].position;
    result.position += result.N[i] * p;
    J += local.col(i) * p.transpose();
  }
  result.gradient = J.inverse() * local;
  result.signed_area = J.determinant() / 2;
  result.area = std::abs(result.signed_area);
  return result;
}

}  // namespace trammel::solver
