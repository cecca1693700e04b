#pragma once

#include <Eigen/Core>
#include <cmath>

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

}  // namespace trammel::solver
