#pragma once

#include <array>
#include <cmath>

#include "references/frames/frame.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

/// Exact dynamic stiffness of one uniform member at circular frequency w, and the number of its
/// natural frequencies below w with both ends clamped. Sources: Wittrick and Williams 1971; for
/// shear and rotary inertia, Howson and Williams 1973.
///
/// With g = w^2 rho A / (kappa G A) and r = w^2 rho I / EI (both zero for Euler-Bernoulli) the wave
/// numbers of deflection v and rotation psi follow from
///   k^4 + (g + r - T/EI) k^2 + g r - w^2 rho A / EI = 0,
/// where T is the tension of a prestressed Euler-Bernoulli member, which adds T v' to the force V
/// below. Even and odd motions about mid-span decouple. With C = cos(h) or cosh, S = sin or sinh of
/// k x over k, x from mid-span,
///   even: v = C,      psi = (k^2 + g) S,  M = EI (k^2 + g) C,
///         V = -(k^2 + g)(EI k^2 + w^2 rho I) S;
///   odd:  v = k^2 S,  psi = (k^2 + g) C,  M = EI (k^2 + g) k^2 S,
///         V = -(k^2 + g)(EI k^2 + w^2 rho I) C.
/// Hyperbolic pairs are divided by cosh(k L/2), which avoids overflow.
namespace trammel::references {

/// Stiffness of motions even and odd about mid-span: forces (N, V, M) at the right end over the
/// displacements (u, v, psi) there.
template <class T>
struct MemberStiffness {
  Eigen::Matrix<T, 3, 3> even = Eigen::Matrix<T, 3, 3>::Zero(), odd = even;
  int clamped_below = 0;  ///< frequencies below w with both ends clamped
};

/// Properties of a member in the number type of the evaluation.
template <class T>
struct MemberData {
  explicit MemberData(const FrameSection& s, const Real& L)
      : length(static_cast<T>(L)),
        axial_compliance(static_cast<T>(s.axial_compliance)),
        EI(static_cast<T>(s.EI)),
        shear_compliance(static_cast<T>(s.shear_compliance)),
        mass(static_cast<T>(s.mass)),
        rotary_inertia(static_cast<T>(s.rotary_inertia)),
        tension(static_cast<T>(s.tension)) {}
  T length, axial_compliance, EI, shear_compliance, mass, rotary_inertia, tension;
};

namespace detail {

/// C and S at half length h for a squared wave number of either sign, divided by cosh where
/// hyperbolic.
template <class T>
std::array<T, 2> symmetric_wave_functions(const T& k2, const T& h) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  using std::tanh;
  if (k2 == 0) return {T(1), h};
  if (k2 > 0) {
    const T k = sqrt(k2);
    return {T(1), tanh(k * h) / k};
  }
  const T k = sqrt(-k2);
  return {cos(k * h), sin(k * h) / k};
}

/// Returns the number of n >= 1 with n pi / L < k.
template <class T>
int waves_below(const T& k, const T& length) {
  using std::ceil;
  const T n = ceil(k * length / pi<T>()) - 1;
  return n > 0 ? static_cast<int>(n) : 0;
}

/// Bending at w^2: the stiffnesses of motions even and odd about mid-span, and the clamped
/// frequencies.
template <class T>
MemberStiffness<T> bending_stiffness(const MemberData<T>& m, const T& w2, const T& load_factor) {
  using std::sqrt;
  const T h = m.length / 2;
  const T g = w2 * m.mass * m.shear_compliance;
  const T r = w2 * m.rotary_inertia / m.EI;
  const T tension = load_factor * m.tension;
  const T p = (g + r - tension / m.EI) / 2;
  const T q = g * r - w2 * m.mass / m.EI;
  const T root = sqrt(p * p - q);
  // `below` always oscillates, `above` only beyond the cut-on of shear waves; neither cancels
  const T below = p >= 0 ? T(-p - root) : T(q / (root - p));
  const T above = p >= 0 ? T(q / below) : T(root - p);
  Eigen::Matrix<T, 2, 2> even_motion, even_force, odd_motion, odd_force;  // of two solutions
  for (int i = 0; i < 2; ++i) {
    const T k2 = i == 0 ? above : below;
    const auto [C, S] = symmetric_wave_functions(k2, h);
    const T slope = k2 + g;
    const T shear = -slope * (m.EI * k2 + w2 * m.rotary_inertia) + tension * k2;
    even_motion(0, i) = C;
    even_motion(1, i) = slope * S;
    even_force(0, i) = shear * S;
    even_force(1, i) = m.EI * slope * C;
    odd_motion(0, i) = k2 * S;
    odd_motion(1, i) = slope * C;
    odd_force(0, i) = shear * C;
    odd_force(1, i) = m.EI * slope * k2 * S;
  }
  MemberStiffness<T> result;
  result.even.template bottomRightCorner<2, 2>() = even_force * even_motion.inverse();
  result.odd.template bottomRightCorner<2, 2>() = odd_force * odd_motion.inverse();
  // Pinned ends have known frequencies; clamping the two rotations takes away as many as their
  // stiffness has negative eigenvalues.
  int pinned = waves_below(T(sqrt(-below)), m.length);
  if (above < 0) pinned += 1 + waves_below(T(sqrt(-above)), m.length);
  result.clamped_below = pinned - (result.even(2, 2) < 0 ? 1 : 0) - (result.odd(2, 2) < 0 ? 1 : 0);
  return result;
}

}  // namespace detail

/// @param w2  w^2 > 0 [1/s^2].
/// @param load_factor  multiplies the member's tension.
template <class T>
[[nodiscard]] MemberStiffness<T> member_stiffness(const MemberData<T>& m, const T& w2,
                                                  const T& load_factor) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T h = m.length / 2;
  MemberStiffness<T> result = detail::bending_stiffness(m, w2, load_factor);
  if (m.axial_compliance == 0) {
    result.even(0, 0) = -w2 * m.mass * h;
    return result;
  }
  const T k = sqrt(w2 * m.mass * m.axial_compliance);
  const T c = cos(k * h);
  const T s = sin(k * h);
  result.odd(0, 0) = k * c / (s * m.axial_compliance);
  result.even(0, 0) = -k * s / (c * m.axial_compliance);
  result.clamped_below += detail::waves_below(k, m.length);
  return result;
}

/// Returns the 6 x 6 matrix of (u1, v1, psi1, u2, v2, psi2) in the member's axes. Motions u and v
/// have the same sign at both ends if they are even, psi the opposite sign.
template <class T>
[[nodiscard]] Eigen::Matrix<T, 6, 6> member_matrix(const MemberStiffness<T>& s) {
  Eigen::Matrix<T, 6, 6> K;
  K << s.even + s.odd, s.even - s.odd, s.even - s.odd, s.even + s.odd;
  K.row(2) = -K.row(2);
  K.col(2) = -K.col(2);
  return K / T(2);
}

}  // namespace trammel::references
