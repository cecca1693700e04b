#pragma once

#include <array>
#include <string>

#include "references/numerics/arguments.h"

/// Where the joints of a planar 3-RRR are, in closed form, and which of its numbers are given.
/// Number: Real, or Jet<Real> for a motion.
namespace trammel::references {

template <class Number>
using Point2 = std::array<Number, 2>;

/// Vertices of an equilateral triangle about `centre`, at 210, 330 and 90 degrees plus `angle`.
template <class Number>
[[nodiscard]] std::array<Point2<Number>, 3> triangle(const Point2<Number>& centre, const Real& side,
                                                     const Number& angle) {
  const Real radius = side / sqrt(Real(3));
  std::array<Point2<Number>, 3> vertices;
  for (int i = 0; i < 3; ++i) {
    const Number direction = angle + Real(pi<Real>() * (7 + 4 * i) / 6);
    vertices[i] = {centre[0] + radius * cos(direction), centre[1] + radius * sin(direction)};
  }
  return vertices;
}

/// The intersection of the circles about A and C; mode -1 lies clockwise of the line A C.
/// @throws DerivationError  where there is none.
template <class Number>
[[nodiscard]] Point2<Number> elbow(const Point2<Number>& A, const Point2<Number>& C,
                                   const Real& proximal, const Real& distal, int mode) {
  const Number dx = C[0] - A[0];
  const Number dy = C[1] - A[1];
  const Number r2 = dx * dx + dy * dy;
  const Real squares = proximal * proximal - distal * distal;
  const Number along = (squares + r2) / (Real(2) * r2);  // of A C
  const Number height2 = Real(proximal * proximal) / r2 - along * along;
  if (height2 < Real(0)) throw DerivationError("a limb cannot reach its platform joint");
  const Number across = Real(mode) * sqrt(height2);
  return {A[0] + along * dx - across * dy, A[1] + along * dy + across * dx};
}

/// Whether a mass or an inertia is a number, not one of the texts "from-density" and "from-mass".
[[nodiscard]] inline bool is_given(const Arguments& object, const std::string& key) {
  return object.has(key) && object[key] != "from-density" && object[key] != "from-mass";
}

/// A mass [kg] or an inertia [kg m^2] where it is given, otherwise what the texts stand for.
[[nodiscard]] inline Real given_or(const Arguments& object, const std::string& key,
                                   const Real& computed) {
  return is_given(object, key) ? object.positive(key) : computed;
}

}  // namespace trammel::references
