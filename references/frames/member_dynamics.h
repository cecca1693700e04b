#pragma once

#include <array>
#include <cmath>

#include "references/frames/frame.h"
#include "references/numerics/real.h"

/// Exact dynamic stiffness of one uniform member at circular frequency w, and how many of its
/// natural frequencies with both ends clamped lie below w (Wittrick and Williams 1971; for shear
/// and rotary inertia Howson and Williams 1973).
///
/// With g = w^2 rho A / (kappa G A) and r = w^2 rho I / EI (both zero for Euler-Bernoulli) the wave
/// numbers of deflection v and rotation psi follow from
///   k^4 + (g + r - T/EI) k^2 + g r - w^2 rho A / EI = 0,
/// T the tension of a prestressed Euler-Bernoulli member, which adds T v' to the force V below.
/// Motions even and odd about mid-span decouple; with C = cos(h) or cosh, S = sin or sinh of k x
/// over k, x from mid-span,
///   even: v = C,      psi = (k^2 + g) S,  M = EI (k^2 + g) C,
///         V = -(k^2 + g)(EI k^2 + w^2 rho I) S;
///   odd:  v = k^2 S,  psi = (k^2 + g) C,  M = EI (k^2 + g) k^2 S,
///         V = -(k^2 + g)(EI k^2 + w^2 rho I) C.
/// Hyperbolic pairs are divided by cosh(k L/2), so that nothing overflows.
namespace trammel::references {

/// Symmetric 2 x 2: force and moment at the right end over v and psi there.
template <class T>
struct HalfStiffness {
  T vv, vp, pp;
};

template <class T>
struct MemberStiffness {
  HalfStiffness<T> even, odd;  ///< bending
  T axial_odd, axial_even;     ///< axial: ends apart by 2 u, both ends by u
  int clamped_below = 0;       ///< frequencies below w with both ends clamped
};

/// What a member is made of, in the number type of the evaluation.
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

/// (forces of two solutions) (displacements of two solutions)^-1.
template <class T>
HalfStiffness<T> stiffness_from_solutions(const std::array<std::array<T, 2>, 2>& force,
                                          const std::array<std::array<T, 2>, 2>& motion) {
  const T det = motion[0][0] * motion[1][1] - motion[0][1] * motion[1][0];
  return {(force[0][0] * motion[1][1] - force[0][1] * motion[1][0]) / det,
          (force[0][1] * motion[0][0] - force[0][0] * motion[0][1]) / det,
          (force[1][1] * motion[0][0] - force[1][0] * motion[0][1]) / det};
}

/// How many n >= 1 have n pi / L < k.
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
  std::array<std::array<T, 2>, 2> even_motion, even_force, odd_motion, odd_force;
  for (int i = 0; i < 2; ++i) {
    const T k2 = i == 0 ? above : below;
    const auto [C, S] = symmetric_wave_functions(k2, h);
    const T slope = k2 + g;
    const T shear = -slope * (m.EI * k2 + w2 * m.rotary_inertia) + tension * k2;
    even_motion[0][i] = C;
    even_motion[1][i] = slope * S;
    even_force[0][i] = shear * S;
    even_force[1][i] = m.EI * slope * C;
    odd_motion[0][i] = k2 * S;
    odd_motion[1][i] = slope * C;
    odd_force[0][i] = shear * C;
    odd_force[1][i] = m.EI * slope * k2 * S;
  }
  MemberStiffness<T> result{stiffness_from_solutions(even_force, even_motion),
                            stiffness_from_solutions(odd_force, odd_motion), T(0), T(0), 0};
  // Pinned ends have known frequencies; clamping the two rotations takes away as many as their
  // stiffness has negative eigenvalues.
  int pinned = waves_below(T(sqrt(-below)), m.length);
  if (above < 0) pinned += 1 + waves_below(T(sqrt(-above)), m.length);
  result.clamped_below = pinned - (result.even.pp < 0 ? 1 : 0) - (result.odd.pp < 0 ? 1 : 0);
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
    result.axial_even = -w2 * m.mass * h;
    return result;
  }
  const T k = sqrt(w2 * m.mass * m.axial_compliance);
  const T c = cos(k * h);
  const T s = sin(k * h);
  result.axial_odd = k * c / (s * m.axial_compliance);
  result.axial_even = -k * s / (c * m.axial_compliance);
  result.clamped_below += detail::waves_below(k, m.length);
  return result;
}

/// The 6 x 6 of (u1, v1, psi1, u2, v2, psi2) in the member's axes.
template <class T>
[[nodiscard]] std::array<std::array<T, 6>, 6> member_matrix(const MemberStiffness<T>& s) {
  std::array<std::array<T, 6>, 6> K{};
  const auto set = [&K](int i, int j, const T& value) { K[i][j] = K[j][i] = value; };
  set(0, 0, (s.axial_even + s.axial_odd) / 2);
  set(3, 3, (s.axial_even + s.axial_odd) / 2);
  set(0, 3, (s.axial_even - s.axial_odd) / 2);
  set(1, 1, (s.even.vv + s.odd.vv) / 2);
  set(4, 4, (s.even.vv + s.odd.vv) / 2);
  set(1, 4, (s.even.vv - s.odd.vv) / 2);
  set(2, 2, (s.even.pp + s.odd.pp) / 2);
  set(5, 5, (s.even.pp + s.odd.pp) / 2);
  set(2, 5, (s.odd.pp - s.even.pp) / 2);
  set(4, 5, (s.even.vp + s.odd.vp) / 2);
  set(1, 2, -(s.even.vp + s.odd.vp) / 2);
  set(1, 5, (s.even.vp - s.odd.vp) / 2);
  set(2, 4, (s.odd.vp - s.even.vp) / 2);
  return K;
}

}  // namespace trammel::references
