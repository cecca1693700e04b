#include "harness/judge/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/number.h"

namespace trammel::harness {
namespace {

using results::Number;

/// Relative tolerance for the agreement of an observed order of convergence with the theoretical
/// order, or with the order on the adjacent refinement level.
constexpr double kOrderTolerance = 0.1;

bool orders_agree(double order, double other) {
  return std::abs(order - other) <= kOrderTolerance * std::max(std::abs(other), 1.0);
}

double relative_distance(double value, double reference) {
  return std::abs(value - reference) / std::abs(reference);
}

/// Returns the order p of three values with an error proportional to h^p:
///   (v0 - v1) / (v1 - v2) = (h0^p - h1^p) / (h1^p - h2^p).
/// Returns NaN if the values do not approach a limit from one side, or p is not in (0, 20).
double order_of_three(const std::vector<double>& v, const std::vector<double>& h, std::size_t k) {
  const double ratio = (v[k - 2] - v[k - 1]) / (v[k - 1] - v[k]);
  if (!std::isfinite(ratio) || ratio <= 0) return kNaN;
  // Element sizes are scaled by h1 so that powers with a large p do not overflow.
  const double coarse = h[k - 2] / h[k - 1], fine = h[k] / h[k - 1];
  const auto excess = [&](double p) {
    return (std::pow(coarse, p) - 1) / (1 - std::pow(fine, p)) - ratio;
  };
  double low = 1e-3, high = 20;
  if (excess(low) > 0 || excess(high) < 0) return kNaN;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Returns the observed order of convergence from the errors on two refinement levels.
double order_of_two_errors(double coarse, double fine, double h_coarse, double h_fine) {
  return std::log(coarse / fine) / std::log(h_coarse / h_fine);
}

/// Analyzes the convergence of a series of values. Refinement levels without a value are skipped.
class ConvergenceStudy {
 public:
  explicit ConvergenceStudy(Convergence& series) : series_(series) {
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      if (!series.values[i]) {
        series.broken = series.broken || !level_.empty();
        continue;
      }
      level_.push_back(i);
      v_.push_back(*series.values[i]);
      h_.push_back(series.size[i]);
      roundoff_.push_back(std::max(*series.roundoff[i], std::numeric_limits<double>::epsilon()));
    }
  }

  void run() {
    observe();
    extrapolate();
    measure_errors();
    find_range();
    if (!series_.lower_order)
      series_.fitted_order = log_log_slope(h_, {error_.begin(), error_.end()}, in_range_);
    spread(series_.error, error_);
    spread(series_.order, order_);
    spread(series_.gci, gci_);
    spread(series_.safety_factor, factor_);
    spread(series_.in_asymptotic_range, in_range_);
    spread(series_.at_roundoff_floor, at_floor_);
    if (series_.two_term) {
      const std::vector<bool> used = series_.two_term->used;
      spread(series_.two_term->used, used);
    }
  }

 private:
  [[nodiscard]] std::size_t count() const { return v_.size(); }

  /// Computes the observed orders of convergence from the values alone, without an exact value.
  void observe() {
    observed_.assign(count(), kNaN);
    for (std::size_t k = 2; k < count(); ++k) observed_[k] = order_of_three(v_, h_, k);
  }

  /// Returns true if the values on three refinement levels do not converge (order zero or less). An
  /// example is the stress at a reentrant corner.
  [[nodiscard]] bool diverges(std::size_t k) const {
    if (k < 2) return false;
    const double before = std::abs(v_[k - 1] - v_[k - 2]), last = std::abs(v_[k] - v_[k - 1]);
    if (last <= kRoundoffMargin * roundoff_[k] * std::abs(v_[k])) return false;
    return last * std::log(h_[k - 2] / h_[k - 1]) >= before * std::log(h_[k - 1] / h_[k]);
  }

  /// Converged value, extrapolated from the values on successive refinement levels, and the safety
  /// factor of its uncertainty.
  struct Expected {
    double value = kNaN, factor = 3;
  };

  /// Returns the Richardson extrapolation of the values on the levels k - 1 and k with the order
  /// `order`.
  [[nodiscard]] double extrapolated(std::size_t k, double order) const {
    return v_[k] + (v_[k] - v_[k - 1]) / (std::pow(h_[k - 1] / h_[k], order) - 1);
  }

  /// Returns true if `order` agrees with the theoretical order, or is between two theoretical
  /// orders that mix.
  [[nodiscard]] bool is_theoretical_order(double order) const {
    if (!series_.theory_order || std::isnan(order)) return false;
    if (!series_.lower_order) return orders_agree(order, *series_.theory_order);
    const bool inside = order > *series_.lower_order && order < *series_.theory_order;
    return inside || orders_agree(order, *series_.theory_order) ||
           orders_agree(order, *series_.lower_order);
  }

  [[nodiscard]] Expected expected(std::size_t k) const {
    const double seen = observed_[k];
    if (diverges(k)) return {};
    if (!series_.theory_order)
      return {extrapolated(k, std::isnan(seen) ? 1 : std::max(0.5, seen)), 3};
    const double lowest = series_.lower_order.value_or(*series_.theory_order);
    // An observed order requires three levels. On two levels, the theoretical order applies, with
    // Roache's safety factor 3.
    if (k == 1) return {extrapolated(k, lowest), 3};
    // The values oscillate, so that they have no observed order.
    if (std::isnan(seen)) return {extrapolated(k, std::min(1.0, lowest)), 3};
    if (is_theoretical_order(seen) && series_.lower_order) {
      const double value =
          extrapolate_two_term_law({h_[k - 2], h_[k - 1], h_[k]}, {v_[k - 2], v_[k - 1], v_[k]},
                                   {*series_.theory_order, *series_.lower_order});
      if (std::isfinite(value)) return {value, 1.25};
    }
    if (is_theoretical_order(seen)) return {extrapolated(k, *series_.theory_order), 1.25};
    // An observed order above the theoretical order does not persist under refinement, so it is
    // reduced to the theoretical order.
    return {extrapolated(k, std::clamp(seen, std::min(0.5, lowest), lowest)), 3};
  }

  void extrapolate() {
    gci_.assign(count(), kNaN);
    factor_.assign(count(), kNaN);
    double before = kNaN, min_change = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < count(); ++k) {
      const auto [value, factor] = expected(k);
      gci_[k] = factor * std::abs((value - v_[k]) / v_[k]) + roundoff_[k];
      factor_[k] = factor;
      // Each level yields an extrapolated value. The result is the extrapolated value with the
      // smallest sum of round-off error and change from the previous level.
      const double from = std::isfinite(before) ? before : v_[k];
      const double change = std::abs(value - from) + roundoff_[k] * std::abs(value);
      before = value;
      if (k < 2 || !(change < min_change)) continue;
      min_change = change;
      series_.richardson = value;
    }
  }

  void measure_errors() {
    error_.assign(count(), kNaN);
    order_.assign(count(), kNaN);
    const Number reference = series_.exact ? series_.exact : series_.richardson;
    for (std::size_t k = 0; reference && k < count(); ++k) {
      if (series_.is_error) error_[k] = std::abs(v_[k]);
      if (!series_.is_error && *reference != 0) error_[k] = relative_distance(v_[k], *reference);
    }
    for (std::size_t k = 1; k < count(); ++k)
      order_[k] = series_.exact ? order_of_two_errors(error_[k - 1], error_[k], h_[k - 1], h_[k])
                                : observed_[k];
  }

  /// Fits the two-term law a h^p + b h^q to the errors if two orders of convergence mix.
  /// @returns true if the case states two orders of convergence
  bool fit_two_orders() {
    if (!series_.theory_order || !series_.lower_order) return false;
    const Number reference = series_.exact ? series_.exact : series_.richardson;
    if (!reference || *reference == 0) return false;
    std::vector<double> signed_error;
    std::vector<bool> usable;
    for (std::size_t k = 0; k < count(); ++k) {
      signed_error.push_back((v_[k] - *reference) / std::abs(*reference));
      usable.push_back(!at_floor_[k]);
    }
    series_.two_term = fit_two_term_error_law(
        h_, signed_error, usable, {*series_.theory_order, *series_.lower_order}, kTwoTermTolerance);
    if (series_.two_term && series_.two_term->max_relative_misfit <= kTwoTermTolerance)
      in_range_ = series_.two_term->used;
    return true;
  }

  void find_range() {
    in_range_.assign(count(), false);
    at_floor_.assign(count(), false);
    for (std::size_t k = 0; k < count(); ++k) {
      // Round-off errors are relative to the values v_. If the values are errors themselves, the
      // error relative to v_ is 1.
      const double clear = series_.is_error ? 1.0 : error_[k];
      at_floor_[k] = clear <= kRoundoffMargin * roundoff_[k];
    }
    if (fit_two_orders()) return;
    for (std::size_t k = 1; k < count(); ++k) {
      const bool like_before = k > 1 && orders_agree(order_[k], order_[k - 1]);
      const bool like_after =
          k + 1 < count() && !at_floor_[k + 1] && orders_agree(order_[k], order_[k + 1]);
      in_range_[k] = !at_floor_[k] && (like_before || like_after);
    }
  }

  template <class All, class Values>
  void spread(All& all, const Values& found) const {
    all.assign(series_.values.size(), typename All::value_type{});
    for (std::size_t k = 0; k < found.size(); ++k) all[level_[k]] = found[k];
  }

  Convergence& series_;
  std::vector<std::size_t> level_;
  std::vector<double> v_, h_, roundoff_, observed_, error_, order_, gci_, factor_;
  std::vector<bool> in_range_, at_floor_;
};

}  // namespace

std::optional<double> log_log_slope(const std::vector<double>& size, const results::Numbers& error,
                                    const std::vector<bool>& chosen) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!chosen[k]) continue;
    const double x = std::log(size[k]), y = std::log(std::abs(*error[k]));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread_of_x = n * sxx - sx * sx;
  if (n < 2 || !(spread_of_x > 0)) return std::nullopt;
  return (n * sxy - sx * sy) / spread_of_x;
}

Convergence analyze_convergence(Convergence series) {
  ConvergenceStudy(series).run();
  return series;
}

using results::TwoTermLaw;

namespace {

/// Fits a and b of the two-term law to the errors on selected levels by least squares of
///   1 = (a h^p + b h^q) / error.
class Fit {
 public:
  Fit(const std::vector<double>& h, const std::vector<double>& error, const TwoTermOrders& law)
      : h_(h), error_(error), law_(law) {}

  [[nodiscard]] std::optional<TwoTermLaw> over(const std::vector<bool>& levels) const {
    double pp = 0, pq = 0, qq = 0, p1 = 0, q1 = 0;
    for (std::size_t k = 0; k < h_.size(); ++k) {
      if (!levels[k]) continue;
      const auto [p, q] = terms(k);
      pp += p * p, pq += p * q, qq += q * q, p1 += p, q1 += q;
    }
    const double determinant = pp * qq - pq * pq;
    if (!(determinant > 1e-12 * pp * qq)) return std::nullopt;
    const double a = (qq * p1 - pq * q1) / determinant, b = (pp * q1 - pq * p1) / determinant;
    double worst = 0;
    for (std::size_t k = 0; k < h_.size(); ++k) {
      if (!levels[k]) continue;
      const auto [p, q] = terms(k);
      worst = std::max(worst, std::abs(a * p + b * q - 1));
    }
    return TwoTermLaw{{a, b}, worst, levels};
  }

 private:
  [[nodiscard]] std::array<double, 2> terms(std::size_t k) const {
    return {std::pow(h_[k], law_.p) / error_[k], std::pow(h_[k], law_.q) / error_[k]};
  }

  const std::vector<double>& h_;
  const std::vector<double>& error_;
  const TwoTermOrders& law_;
};

}  // namespace

std::optional<TwoTermLaw> fit_two_term_error_law(const std::vector<double>& h,
                                                 const std::vector<double>& error,
                                                 const std::vector<bool>& usable,
                                                 const TwoTermOrders& law, double max_residual) {
  std::vector<bool> levels = usable;
  for (std::size_t k = 0; k < levels.size(); ++k)
    levels[k] = levels[k] && std::isfinite(error[k]) && error[k] != 0;
  const Fit fit(h, error, law);
  std::optional<TwoTermLaw> found;
  while (std::ranges::count(levels, true) >= 3) {
    found = fit.over(levels);
    if (found && found->max_relative_misfit <= max_residual) break;
    *std::ranges::find(levels, true) = false;
  }
  return found;
}

double extrapolate_two_term_law(const std::array<double, 3>& h, const std::array<double, 3>& v,
                                const TwoTermOrders& law) {
  // Differences eliminate the limit: v_i - v_2 = a (h_i^p - h_2^p) + b (h_i^q - h_2^q).
  const double fine = h[2];
  const auto p = [&](std::size_t i) { return std::pow(h[i] / fine, law.p) - 1; };
  const auto q = [&](std::size_t i) { return std::pow(h[i] / fine, law.q) - 1; };
  const double determinant = p(0) * q(1) - p(1) * q(0);
  if (determinant == 0 || !std::isfinite(determinant)) return std::nan("");
  const double d0 = v[0] - v[2], d1 = v[1] - v[2];
  const double a = (d0 * q(1) - d1 * q(0)) / determinant, b = (p(0) * d1 - p(1) * d0) / determinant;
  return v[2] - a - b;
}

}  // namespace trammel::harness
