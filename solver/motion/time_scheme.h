#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/model/numbers.h"

namespace trammel::solver {

/// Family of one-step methods with four parameters, for M q'' + C q' + K q = f and for constrained
/// systems. In a step of length h, a is the acceleration that satisfies the equation of motion at
/// the ends of the step. A is the algorithmic acceleration:
///
///     \f[ (1 - \alpha_m) A_1 + \alpha_m A_0 = (1 - \alpha_f) a_1 + \alpha_f a_0, \f]
///     \f[ q_1 = q_0 + h v_0 + h^2 ((1/2 - \beta) A_0 + \beta A_1), \f]
///     \f[ v_1 = v_0 + h ((1 - \gamma) A_0 + \gamma A_1). \f]
///
/// The equation of motion is satisfied at the end of every step instead of at a time within the
/// step. The order of accuracy is therefore the same for the acceleration a, and for matrices that
/// change with time. A approximates the acceleration at a time that is alpha_m - alpha_f steps
/// after that of a. Source: Chung & Hulbert (1993) in the form of Arnold & Bruels (2007). Newmark
/// (1959) has alpha_m = alpha_f = 0.
struct TimeScheme {
  double alpha_m = 0;
  double alpha_f = 0;
  double beta = 0.25;
  double gamma = 0.5;
  /// true: use the energy-momentum method instead, for geometrically exact systems only.
  bool conserves_energy = false;

  /// Returns the change of the algorithmic acceleration A per unit change of a1 at the end of a
  /// step.
  [[nodiscard]] double acceleration_gain() const { return (1 - alpha_f) / (1 - alpha_m); }
  /// Returns the change of v / h per unit change of the acceleration a1 at the end of a step.
  [[nodiscard]] double velocity_gain() const { return gamma * acceleration_gain(); }
  /// Returns the change of q / h^2 per unit change of the acceleration a1 at the end of a step.
  [[nodiscard]] double position_gain() const { return beta * acceleration_gain(); }
  /// Returns the constant c of the local error c h^2 (A1 - A0) of a position (Zienkiewicz & Xie
  /// 1991). The result is at least 1/12, because the velocity has an error even if the error of the
  /// position is zero.
  [[nodiscard]] double error_constant() const {
    return std::max(1.0 / 12, std::abs(beta + (alpha_m - alpha_f) / 2 - 1.0 / 6));
  }
};

/// Returns Newmark's method.
/// @throws ModelError  if beta < 0, or gamma < 1/2 (negative damping).
[[nodiscard]] TimeScheme newmark(double beta, double gamma);
/// Returns Newmark's trapezoidal rule: order 2, energy-conserving, stable for any step.
[[nodiscard]] TimeScheme average_acceleration();
/// Returns Newmark's method with beta = 1/6: order 2, stable for w h < sqrt(12), with the angular
/// frequency w and the step h.
[[nodiscard]] TimeScheme linear_acceleration();
/// Returns Newmark's method with beta = 0: order 2, stable for w h < 2, with the angular frequency
/// w and the step h.
[[nodiscard]] TimeScheme central_difference();
/// Returns the method of Hilber, Hughes & Taylor (1977) with -1/3 <= alpha <= 0. alpha = 0 is the
/// trapezoidal rule.
/// @throws ModelError  if alpha is outside the range [-1/3, 0].
[[nodiscard]] TimeScheme hht_alpha(double alpha);
/// Returns the generalized-alpha method of Chung & Hulbert (1993): order 2, stable for any step.
/// @param radius  factor in [0, 1] by which a step multiplies vibrations whose period is much
///   shorter than the step. The factor 1 conserves such vibrations, and 0 removes them.
/// @throws ModelError  if the radius is outside the range [0, 1].
[[nodiscard]] TimeScheme generalized_alpha(double radius);

/// Returns the spectral radius of a step h at the angular frequency w, with w h = `phase_step`. It
/// is the largest factor by which a step multiplies a free undamped motion. The scheme is unstable
/// if this factor exceeds 1.
[[nodiscard]] double spectral_radius(const TimeScheme& scheme, double phase_step);

/// Returns the largest product w h of angular frequency and step for which an undamped motion
/// remains bounded. The result is infinity if the scheme is stable for any step. For Newmark's
/// method, the limit is 1 / sqrt(gamma/2 - beta) (Hughes 1987, section 9.1). The other methods are
/// stable for any step.
[[nodiscard]] double stability_limit(const TimeScheme& scheme);

// Relations of the time scheme, applied to states with positions q, velocities v and accelerations
// a.

/// Computes the algorithmic acceleration A, positions q and velocities v at the end of a step from
/// the acceleration a at the end (`to.a`).
template <class State>
void predict(const TimeScheme& s, double h, const State& from, const Eigen::VectorXd& A0, State& to,
             Eigen::VectorXd& A1) {
  A1 = ((1 - s.alpha_f) * to.a + s.alpha_f * from.a - s.alpha_m * A0) / (1 - s.alpha_m);
  to.q = from.q + h * from.v + h * h * ((0.5 - s.beta) * A0 + s.beta * A1);
  to.v = from.v + h * ((1 - s.gamma) * A0 + s.gamma * A1);
}

/// Adds a correction to the acceleration a at the end of a step, and changes the algorithmic
/// acceleration A and the velocity v accordingly.
template <class State, class Correction>
void correct(const TimeScheme& s, double h, const Correction& correction, State& to,
             Eigen::VectorXd& A1) {
  to.a += correction;
  A1 += s.acceleration_gain() * correction;
  to.v += (s.velocity_gain() * h) * correction;
}

/// Converts the algorithmic acceleration A to a new step size, because the time of A depends on the
/// step size. `ratio` is new step / old step, and a is the acceleration that satisfies the equation
/// of motion.
inline void rescale_to_new_step(double ratio, const Eigen::VectorXd& a, Eigen::VectorXd& A) {
  A = a + ratio * (A - a);
}

/// Returns the largest difference between the two sides of the relations between q, v, a and A in a
/// step of size h, relative to the sum of the terms of each relation [-]. If `positions` is false,
/// the relation of positions is omitted, because constraints modify this relation. `norm` returns
/// the norm of a vector of coordinates, `defect` is a work vector, and `force_roundoff` is the
/// magnitude of the accelerations that result from round-off errors of forces.
template <class State, class Norm>
double relation_residual(const TimeScheme& s, double h, const State& from,
                         const Eigen::VectorXd& A0, const State& to, const Eigen::VectorXd& A1,
                         bool positions, const Norm& norm, Eigen::VectorXd& defect,
                         double force_roundoff = 0) {
  // If a body stops moving, its computed accelerations are round-off errors of its positions
  // divided by beta h^2. A, a, v and q are sums of magnitudes by which the residuals of the
  // relations are divided. These sums are increased so that round-off errors divided by the sums
  // are at most kRoundoffShare, a tenth of the limit for Residual::equation_of_motion.
  constexpr double kRoundoffShare = 1e-5;
  const double roundoff =
      kEps * (norm(from.q) + norm(to.q)) / (std::max(s.beta, 1.0 / 12) * h * h) + force_roundoff;
  const double A = norm(A0) + norm(A1) + roundoff / kRoundoffShare;
  const double a = norm(from.a) + norm(to.a) + A;
  const double v = norm(from.v) + norm(to.v) + h * A;
  const double q = norm(from.q) + norm(to.q) + h * v;
  // Magnitude below which motions are treated as zero, because underflow removes their digits.
  // Numerical damping can reduce motions to such magnitudes.
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
