#include "harness/judge/two_term.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::harness {

using results::TwoTermLaw;

namespace {

/// Least squares for 1 = (a h^p + b h^q) / error over levels first, first + 1, ...
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

std::optional<TwoTermLaw> fit_two_terms(const std::vector<double>& h,
                                        const std::vector<double>& error,
                                        const std::vector<bool>& usable, const TwoTermOrders& law,
                                        double within) {
  std::vector<bool> levels = usable;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k] = levels[k] && std::isfinite(error[k]) && error[k] != 0;
  }
  const Fit fit(h, error, law);
  std::optional<TwoTermLaw> found;
  while (std::ranges::count(levels, true) >= 3) {
    found = fit.over(levels);
    if (found && found->max_relative_misfit <= within) break;
    *std::ranges::find(levels, true) = false;
  }
  return found;
}

double extrapolate_two_terms(const std::array<double, 3>& h, const std::array<double, 3>& v,
                             const TwoTermOrders& law) {
  // Differences rid of the limit, then of b: v_i - v_2 = a (h_i^p - h_2^p) + b (h_i^q - h_2^q).
  const double fine = h[2];
  const auto p = [&](std::size_t i) { return std::pow(h[i] / fine, law.p) - 1; };
  const auto q = [&](std::size_t i) { return std::pow(h[i] / fine, law.q) - 1; };
  const double determinant = p(0) * q(1) - p(1) * q(0);
  if (determinant == 0 || !std::isfinite(determinant)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double d0 = v[0] - v[2];
  const double d1 = v[1] - v[2];
  const double a = (d0 * q(1) - d1 * q(0)) / determinant;
  const double b = (p(0) * d1 - p(1) * d0) / determinant;
  return v[2] - a - b;
}

}  // namespace trammel::harness
