#include <algorithm>
#include <array>

#include "references/manipulator/programs.h"
#include "references/numerics/jet.h"
#include "references/numerics/real.h"

/// Computes all poses of a planar 3-RRR manipulator at given angles of its actuators, and proves
/// that no other poses exist (J.-P. Merlet, Parallel Robots, 2nd ed., 2006, section 4.3). With the
/// elbows B_i, the joints c_i of the platform and D_i = B_i - R(phi) c_i, the platform's point P is
/// on three circles about D_i. Eliminating x and y leaves a trigonometric polynomial Q(phi) of
/// degree 3, with at most six zeros. By Bernstein the k-th derivative is at most 3^k max|Q|.
/// Intervals are halved until each is shown to have no zero, one or, on both sides of an extremum,
/// two.
namespace trammel::references {

namespace {

template <class T>
T dot(const Point2<T>& a, const Point2<T>& b) {
  return a[0] * b[0] + a[1] * b[1];
}

struct Limbs {
  std::array<Point2<Real>, 3> elbow;
  std::vector<Point2<Real>> joint;
  std::vector<Real> distal;
};

/// Returns D_i, the center of the circle about which limb i can move P at the orientation phi.
template <class T>
Point2<T> center(const Limbs& limbs, std::size_t i, const T& phi) {
  const Point2<T> joint = rotated(limbs.joint[i], phi);
  return {T(limbs.elbow[i][0]) - joint[0], T(limbs.elbow[i][1]) - joint[1]};
}

/// Returns (P - D_1) d and d. P is the intersection of two lines. Each line contains the common
/// points of two of the circles about D_1, D_2 and D_3. The determinant of the two lines is d.
template <class T>
std::pair<Point2<T>, T> meeting(const Limbs& limbs, const T& phi) {
  std::array<Point2<T>, 2> a;
  std::array<T, 2> b;
  const Point2<T> first = center(limbs, 0, phi);
  for (std::size_t i = 0; i < 2; ++i) {
    const Point2<T> other = center(limbs, i + 1, phi);
    a[i] = {first[0] - other[0], first[1] - other[1]};
    const Real &l = limbs.distal[0], &m = limbs.distal[i + 1];
    b[i] = (T(Real(m * m - l * l)) - dot(a[i], a[i])) / T(2);
  }
  return {{b[0] * a[1][1] - b[1] * a[0][1], b[1] * a[0][0] - b[0] * a[1][0]},
          a[0][0] * a[1][1] - a[0][1] * a[1][0]};
}

template <class T>
T Q(const Limbs& limbs, const T& phi) {
  const auto [u, determinant] = meeting(limbs, phi);
  return dot(u, u) - T(Real(limbs.distal[0] * limbs.distal[0])) * determinant * determinant;
}

Limbs read_limbs(const Arguments& arguments) {
  Limbs limbs;
  const auto base = arguments.points("base_m", 3);
  limbs.joint = arguments.points("platform_m", 3);
  limbs.distal = arguments.numbers("distal_m", 3);
  const auto proximal = arguments.numbers("proximal_m", 3);
  const auto angle = arguments.numbers("angles_rad", 3);
  for (std::size_t i = 0; i < 3; ++i)
    limbs.elbow[i] = {base[i][0] + proximal[i] * cos(angle[i]),
                      base[i][1] + proximal[i] * sin(angle[i])};
  return limbs;
}

/// Search for all zeros of Q. Bernstein's bounds, such as |Q'| <= 3 max|Q|, prove that Q or Q' is
/// monotonic in an interval.
struct Search {
  const Arguments& arguments;
  const Limbs& limbs;
  Real largest;  ///< upper bound of |Q|
  std::vector<Real> zeros;

  [[nodiscard]] Real at(const Real& phi) const { return Q(limbs, phi); }
  [[nodiscard]] Jet<Real> jet(const Real& phi) const {
    return Q(limbs, Jet<Real>(phi, Real(1), Real(0)));
  }

  /// Adds the zero of the polynomial Q(phi) between the angles `from` and `to`, if Q has a zero
  /// there. Q is monotonic in this interval. A zero at the common end of two intervals is added
  /// once.
  void add_crossing(const Real& from, const Real& to) {
    if ((at(from) < 0) == (at(to) < 0)) return;
    zeros.push_back(refined_root([&](const Real& phi) { return at(phi); }, from, to));
  }

  /// Adds the zeros of Q in an interval in which Q' is monotonic. If Q has an extremum, the zeros
  /// before and after the extremum are added.
  void add_crossings(const Real& from, const Real& to) {
    if ((jet(from).rate < 0) == (jet(to).rate < 0)) return add_crossing(from, to);
    const Real extremum = refined_root([&](const Real& phi) { return jet(phi).rate; }, from, to);
    if (abs(at(extremum)) < Real(1e-40) * largest)
      arguments.fail("angles_rad", "expected angles at which all poses differ");
    add_crossing(from, extremum);
    add_crossing(extremum, to);
  }

  /// Adds all zeros of the polynomial Q(phi) between two angles of the platform.
  void find(const Real& from, const Real& to) {
    const Real h = (to - from) / 2, middle = from + h;
    const Jet<Real> q = jet(middle);
    const Real bend = abs(q.acceleration) + 27 * largest * h;  // bounds |Q''|
    if (abs(q.value) > abs(q.rate) * h + bend * h * h / 2) return;
    if (abs(q.rate) > bend * h) return add_crossing(from, to);
    if (abs(q.acceleration) > 27 * largest * h) return add_crossings(from, to);
    if (h < Real(1e-12))
      arguments.fail("angles_rad", "expected angles at which no three poses meet");
    find(from, middle);
    find(middle, to);
  }
};

std::vector<Real> zeros_of_polynomial(const Arguments& arguments, const Limbs& limbs) {
  constexpr int kPoints = 64;
  const Real h = 2 * pi<Real>() / kPoints;
  Real largest = 0;
  for (int i = 0; i < kPoints; ++i) largest = std::max(largest, Real(abs(Q(limbs, Real(h * i)))));
  // Between two samples at a distance of h, |Q| exceeds the largest sample by at most 3 max|Q| h/2.
  Search search{arguments, limbs, largest / (1 - 3 * h / 2), {}};
  search.find(-pi<Real>(), pi<Real>());
  return search.zeros;
}

}  // namespace

std::vector<Real> assembly_modes_program(const Arguments& arguments) {
  const Limbs limbs = read_limbs(arguments);
  const std::vector<Real> zeros = zeros_of_polynomial(arguments, limbs);
  if (arguments.choice("output", "", {"count", "poses"}) == "count") return {Real(zeros.size())};
  std::vector<Real> poses;
  for (const Real& phi : zeros) {
    const auto [u, determinant] = meeting(limbs, phi);
    const Point2<Real> first = center(limbs, 0, phi);
    for (std::size_t k = 0; k < 2; ++k) poses.push_back(first[k] + u[k] / determinant);
    poses.push_back(phi);
  }
  return poses;
}

}  // namespace trammel::references
