#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>

#include "solver/model/model.h"

/// Vectors in the plane.
namespace trammel::solver {

/// The component out of the plane of a x b: positive where b lies to the left of a.
[[nodiscard]] inline double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The vector turned by 90 degrees to the left.
[[nodiscard]] inline Vector2d perpendicular(const Vector2d& v) {
  return {-v.y(), v.x()};
}

/// The vector turned counterclockwise.   @param angle  [rad]
[[nodiscard]] inline Vector2d rotated(const Vector2d& v, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

/// Diagonal of the box around points [m], by which rotations are compared with translations; 1
/// where the points are one, or none.
/// @param position  of an entry of the range
template <class Range, class Position = std::identity>
[[nodiscard]] double box_diagonal(const Range& range, Position position = {}) {
  if (std::empty(range)) return 1;
  Vector2d low = position(*std::begin(range)), high = low;
  for (const auto& entry : range) {
    const Vector2d& point = position(entry);
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return low == high ? 1 : (high - low).norm();
}

/// The same of a model's nodes.
[[nodiscard]] inline double box_diagonal(const Model& model) {
  return box_diagonal(model.nodes, [](const Node& node) { return node.position; });
}

}  // namespace trammel::solver
