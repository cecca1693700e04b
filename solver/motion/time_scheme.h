#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::solver {

/// One-step methods for M q'' + C q' + K q = f and for constrained systems, all members of one
/// family of four numbers. With a the accelerations that satisfy the equation of motion at the ends
/// of a step of length h, and A the scheme's own,
///
///     (1 - alpha_m) A1 + alpha_m A0 = (1 - alpha_f) a1 + alpha_f a0,
///     q1 = q0 + h v0 + h^2 ((1/2 - beta) A0 + beta A1),
///     v1 = v0 + h ((1 - gamma) A0 + gamma A1).
///
/// Equilibrium holds at the end of every step, not at a point within it, so that the order is the
/// same for matrices that change with time, and for a. A belongs to a time that lies
/// alpha_m - alpha_f steps after that of a.
/// Source: Chung & Hulbert (1993) in the form of Arnold & Bruels (2007). Newmark (1959) is
/// alpha_m = alpha_f = 0.
struct TimeScheme {
  double alpha_m = 0;
  double alpha_f = 0;
  double beta = 0.25;
  double gamma = 0.5;
  /// Selects the energy-momentum method instead, for geometrically exact systems only.
  bool conserves_energy = false;

  /// Changes of A, of v over h and of q over h^2 by a unit change of a1.
  [[nodiscard]] double gain() const { return (1 - alpha_f) / (1 - alpha_m); }
  [[nodiscard]] double velocity_gain() const { return gamma * gain(); }
  [[nodiscard]] double position_gain() const { return beta * gain(); }
  /// c of the local error c h^2 (A1 - A0) of a position (Zienkiewicz & Xie 1991). Where it would
  /// vanish the error of v remains, hence at least 1/12.
  [[nodiscard]] double error_constant() const {
    return std::max(1.0 / 12, std::abs(beta + (alpha_m - alpha_f) / 2 - 1.0 / 6));
  }
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
/// Chung & Hulbert (1993): order 2, stable at any step; `radius` in [0, 1] is the factor by which a
/// step reduces a motion much faster than itself: 1 keeps it, 0 removes it.
/// @throws ModelError  outside that range.
[[nodiscard]] TimeScheme generalized_alpha(double radius);

/// Largest factor by which a step of w h = `phase_step` lets a free undamped motion grow; above 1
/// the scheme is unstable there.
[[nodiscard]] double spectral_radius(const TimeScheme& scheme, double phase_step);

/// Largest w h at which an undamped motion stays bounded; infinity if any step is stable. That of
/// Newmark is 1 / sqrt(gamma/2 - beta) (Hughes 1987, section 9.1); the others are stable at any
/// step.
[[nodiscard]] double stability_limit(const TimeScheme& scheme);

// The relations of the scheme for states with q, v and a.

/// Sets A1, q1 and v1 from a1.
template <class State>
void predict(const TimeScheme& s, double h, const State& from, const Eigen::VectorXd& A0, State& to,
             Eigen::VectorXd& A1) {
  A1 = ((1 - s.alpha_f) * to.a + s.alpha_f * from.a - s.alpha_m * A0) / (1 - s.alpha_m);
  to.q = from.q + h * from.v + h * h * ((0.5 - s.beta) * A0 + s.beta * A1);
  to.v = from.v + h * ((1 - s.gamma) * A0 + s.gamma * A1);
}

/// Changes a1, A1 and v1 by a correction of a1.
template <class State, class Correction>
void correct(const TimeScheme& s, double h, const Correction& correction, State& to,
             Eigen::VectorXd& A1) {
  to.a += correction;
  A1 += s.gain() * correction;
  to.v += (s.velocity_gain() * h) * correction;
}

/// Moves A from the time that it has with one step to that with another.
/// @param ratio  of the new step to the old one
inline void change_step(double ratio, const Eigen::VectorXd& a, Eigen::VectorXd& A) {
  A = a + ratio * (A - a);
}

/// Largest difference between the two sides of a relation, over the sum of its terms [-].
/// @param norm  of a vector of coordinates
/// @param positions  false if constraints move positions off their relation
/// @param defect  work
template <class State, class Norm>
double relation_residual(const TimeScheme& s, double h, const State& from,
                         const Eigen::VectorXd& A0, const State& to, const Eigen::VectorXd& A1,
                         bool positions, const Norm& norm, Eigen::VectorXd& defect) {
  // A body that comes to rest has accelerations of round-off: that of the positions, over beta h^2.
  // Terms of which it is more than this share, a tenth of the residual's limit, have no digits.
  constexpr double kRoundoffShare = 1e-5;
  const double roundoff = kEps * (norm(from.q) + norm(to.q)) / (std::max(s.beta, 1.0 / 12) * h * h);
  const double A = norm(A0) + norm(A1) + roundoff / kRoundoffShare;
  const double a = norm(from.a) + norm(to.a) + A;
  const double v = norm(from.v) + norm(to.v) + h * A;
  const double q = norm(from.q) + norm(to.q) + h * v;
  // Motions so small have no digits: what numerical damping leaves of a vibration ends in them.
  constexpr double kUnderflow = std::numeric_limits<double>::min() / kEps;
  const auto share = [&](double terms) {
    const double size = norm(defect);
    return size <= kUnderflow ? 0 : size / terms;
  };
  defect = (1 - s.alpha_m) * A1 + s.alpha_m * A0 - (1 - s.alpha_f) * to.a - s.alpha_f * from.a;
  double largest = share(a);
  defect = to.v - from.v - h * ((1 - s.gamma) * A0 + s.gamma * A1);
  largest = nan_max(largest, share(v));
  if (!positions) return largest;
  defect = to.q - from.q - h * from.v - h * h * ((0.5 - s.beta) * A0 + s.beta * A1);
  return nan_max(largest, share(q));
}

}  // namespace trammel::solver
