#include "harness/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
/// A tenth: of the order, for neighbours to agree and for theory to be met.
constexpr double near = 0.1;

bool is_near(double order, double other) {
  return std::abs(order - other) <= near * std::max(std::abs(other), 1.0);
}

double relative(double value, double truth) {
  return std::abs(value - truth) / std::abs(truth);
}

/// The order p that three values obey with error proportional to h^p:
///   (v0 - v1) / (v1 - v2) = (h0^p - h1^p) / (h1^p - h2^p).
/// NaN where they do not approach a limit from one side, or p is not in (0, 20).
double order_of_three(const std::vector<double>& v, const std::vector<double>& h, std::size_t k) {
  const double ratio = (v[k - 2] - v[k - 1]) / (v[k - 1] - v[k]);
  if (!std::isfinite(ratio) || ratio <= 0) return nothing;
  // Scaled by h1 so that large p do not overflow.
  const double coarse = h[k - 2] / h[k - 1];
  const double fine = h[k] / h[k - 1];
  const auto excess = [&](double p) {
    return (std::pow(coarse, p) - 1) / (1 - std::pow(fine, p)) - ratio;
  };
  double low = 1e-3, high = 20;
  if (excess(low) > 0 || excess(high) < 0) return nothing;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Order between two levels from their errors.
double order_of_errors(double coarse, double fine, double h_coarse, double h_fine) {
  return std::log(coarse / fine) / std::log(h_coarse / h_fine);
}

/// Works on the levels that have a value.
class Study {
 public:
  explicit Study(const Series& series) : series_(series) {
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      if (!std::isfinite(series.values[i])) {
        result_.broken = result_.broken || !level_.empty();
        continue;
      }
      level_.push_back(i);
      v_.push_back(series.values[i]);
      h_.push_back(series.size[i]);
      roundoff_.push_back(std::max(series.roundoff[i], std::numeric_limits<double>::epsilon()));
    }
  }

  Convergence run() {
    observe();
    extrapolate();
    measure_errors();
    find_range();
    result_.fitted_order = slope(h_, error_, in_range_);
    result_.series = series_;
    spread(result_.error, error_);
    spread(result_.order, order_);
    spread(result_.band, band_);
    spread(result_.factor, factor_);
    spread(result_.in_asymptotic_range, in_range_);
    spread(result_.at_roundoff_floor, at_floor_);
    return result_;
  }

 private:
  [[nodiscard]] std::size_t count() const { return v_.size(); }

  /// Orders from the values alone, and which of them to extrapolate with.
  void observe() {
    observed_.assign(count(), nothing);
    for (std::size_t k = 2; k < count(); ++k) observed_[k] = order_of_three(v_, h_, k);
  }

  /// The order and Roache's factor that the level's band is made with.
  [[nodiscard]] std::pair<double, double> order_and_factor(std::size_t k) const {
    const double seen = observed_[k];
    if (!series_.theory) return {std::isnan(seen) ? 1 : std::max(0.5, seen), 3};
    const double theory = *series_.theory;
    if (!std::isnan(seen) && is_near(seen, theory)) return {theory, 1.25};
    // A higher order than theory is no merit: the values are not yet in its range.
    if (std::isnan(seen) || seen > theory) return {std::min(1.0, theory), 3};
    return {std::max(0.5, seen), 3};
  }

  void extrapolate() {
    band_.assign(count(), nothing);
    factor_.assign(count(), nothing);
    double before = nothing, least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < count(); ++k) {
      const auto [order, factor] = order_and_factor(k);
      const double correction = (v_[k] - v_[k - 1]) / (std::pow(h_[k - 1] / h_[k], order) - 1);
      band_[k] = factor * std::abs(correction / v_[k]) + roundoff_[k];
      factor_[k] = factor;
      // The extrapolated value of the level where it changes least, round-off counted in.
      const double value = v_[k] + correction;
      const double change = std::abs(value - before) + roundoff_[k] * std::abs(value);
      before = value;
      if (k < 2 || !(change < least)) continue;
      least = change;
      result_.richardson = value;
    }
  }

  void measure_errors() {
    error_.assign(count(), nothing);
    order_.assign(count(), nothing);
    const std::optional<double> truth = series_.exact ? series_.exact : result_.richardson;
    for (std::size_t k = 0; truth && k < count(); ++k) {
      if (series_.is_error) error_[k] = std::abs(v_[k]);
      if (!series_.is_error && *truth != 0) error_[k] = relative(v_[k], *truth);
    }
    for (std::size_t k = 1; k < count(); ++k) {
      order_[k] = series_.exact ? order_of_errors(error_[k - 1], error_[k], h_[k - 1], h_[k])
                                : observed_[k];
    }
  }

  void find_range() {
    in_range_.assign(count(), false);
    at_floor_.assign(count(), false);
    for (std::size_t k = 0; k < count(); ++k) {
      const double clear = series_.is_error ? 1.0 : error_[k];  // roundoff_ is relative to v_
      at_floor_[k] = !(clear > clear_of_roundoff * roundoff_[k]);
    }
    for (std::size_t k = 1; k < count(); ++k) {
      const bool like_before = k > 1 && is_near(order_[k], order_[k - 1]);
      const bool like_after =
          k + 1 < count() && !at_floor_[k + 1] && is_near(order_[k], order_[k + 1]);
      in_range_[k] = !at_floor_[k] && (like_before || like_after);
    }
  }

  template <class Values>
  void spread(Values& all, const Values& found) const {
    all.assign(series_.values.size(), typename Values::value_type{});
    if constexpr (std::is_same_v<Values, std::vector<double>>) all.assign(all.size(), nothing);
    for (std::size_t k = 0; k < found.size(); ++k) all[level_[k]] = found[k];
  }

  const Series& series_;
  Convergence result_;
  std::vector<std::size_t> level_;
  std::vector<double> v_, h_, roundoff_, observed_, error_, order_, band_, factor_;
  std::vector<bool> in_range_, at_floor_;
};

}  // namespace

std::optional<double> slope(const std::vector<double>& size, const std::vector<double>& error,
                            const std::vector<bool>& chosen) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    if (!chosen[k]) continue;
    const double x = std::log(size[k]), y = std::log(std::abs(error[k]));
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double spread_of_x = n * sxx - sx * sx;
  if (n < 2 || !(spread_of_x > 0)) return std::nullopt;
  return (n * sxy - sx * sy) / spread_of_x;
}

Convergence study(const Series& series) {
  return Study(series).run();
}

}  // namespace trammel
