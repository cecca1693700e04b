#pragma once

/// One-step methods for M q'' + C q' + K q = f, all members of one family of four numbers. With A
/// the accelerations that satisfy the equation of motion at the ends of a step of length h, and a
/// the algorithm's own,
///   (1 - alpha_m) a_1 + alpha_m a_0 = (1 - alpha_f) A_1 + alpha_f A_0,
///   q_1 = q_0 + h v_0 + h^2 ((1/2 - beta) a_0 + beta a_1),
///   v_1 = v_0 + h ((1 - gamma) a_0 + gamma a_1).
/// Equilibrium holds at the end of every step, not at a point within it, so that the order is the
/// same for matrices that change with time, and for A.
/// Source: Chung & Hulbert (1993) in the form of Arnold & Bruels (2007); Newmark (1959) is
/// alpha_m = alpha_f = 0.
namespace trammel::solver {

struct TimeScheme {
  double alpha_m = 0;
  double alpha_f = 0;
  double beta = 0.25;
  double gamma = 0.5;
};

/// @throws ModelError  for beta < 0 or gamma < 1/2 (negative damping).
[[nodiscard]] TimeScheme newmark(double beta, double gamma);
/// Newmark's trapezoidal rule: order 2, keeps the energy, stable at any step.
[[nodiscard]] TimeScheme average_acceleration();
/// Newmark with beta = 1/6: order 2, stable for w h < sqrt(12).
[[nodiscard]] TimeScheme linear_acceleration();
/// Newmark with beta = 0: order 2, stable for w h < 2.
[[nodiscard]] TimeScheme central_difference();
/// Hilber, Hughes & Taylor (1977): -1/3 <= alpha <= 0; 0 is the trapezoidal rule.
/// @throws ModelError  outside that range.
[[nodiscard]] TimeScheme hht_alpha(double alpha);
/// Chung & Hulbert (1993): order 2, stable at any step; `radius` in [0, 1] is what a step leaves of
/// a motion much faster than itself: 1 all of it, 0 nothing.
/// @throws ModelError  outside that range.
[[nodiscard]] TimeScheme generalized_alpha(double radius);

/// Largest factor by which a step of w h = `phase_step` lets a free undamped motion grow; above 1
/// the scheme is unstable there.
[[nodiscard]] double spectral_radius(const TimeScheme& scheme, double phase_step);

/// Largest w h at which an undamped motion stays bounded; infinity where any step is stable.
[[nodiscard]] double stability_limit(const TimeScheme& scheme);

}  // namespace trammel::solver
