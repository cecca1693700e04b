#pragma once

#include <cmath>

#include "solver/manipulator/rigid_manipulator.h"

/// The vectors of one limb at coordinates q, over double or std::complex<double>.
namespace trammel::solver {

using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;
using Matrix93d = Eigen::Matrix<double, 9, 3>;

template <class S>
using Vec2 = Eigen::Matrix<S, 2, 1>;
template <class S>
using Vec9 = Eigen::Matrix<S, 9, 1>;

// Eigen's dot() conjugates, which is not analytic: a complex step needs the plain sum.
template <class S>
S inner(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.x() + a.y() * b.y();
}
template <class S>
S cross(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}
template <class S>
Vec2<S> perp(const Vec2<S>& a) {
  return {-a.y(), a.x()};
}
template <class S>
Vec2<S> direction_of(const S& angle) {
  using std::cos;
  using std::sin;
  return {cos(angle), sin(angle)};
}
template <class S>
Vec2<S> rotated(const Vector2d& v, const Vec2<S>& direction) {
  return {direction.x() * v.x() - direction.y() * v.y(),
          direction.y() * v.x() + direction.x() * v.y()};
}

/// Unit vectors a, e along proximal and distal links, and c = C_i - P.
template <class S>
struct Limb {
  Vec2<S> a, e, c;
  double proximal, distal;
};

template <class S>
Limb<S> limb(const RigidManipulator& m, const Vec9<S>& q, Index i) {
  const auto k = static_cast<std::size_t>(i);
  return {direction_of(q(i)), direction_of(q(3 + i)),
          rotated(m.geometry.platform[k], direction_of(q(8))), m.geometry.proximal[k],
          m.geometry.distal[k]};
}

}  // namespace trammel::solver
