#include "solver/time/load_history.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trammel::solver {

double LoadHistory::at(double t) const {
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  const auto k = static_cast<std::size_t>(next - time.begin());
  if (k == 0) return factor.front();
  if (next == time.end()) return factor.back();
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return factor[k - 1] * (1 - share) + factor[k] * share;
}

std::vector<double> LoadHistory::bends() const {
  std::vector<double> bends;
  double before = 0;
  for (std::size_t k = 0; k < time.size(); ++k) {
    const bool last = k + 1 == time.size();
    const double after = last ? 0 : (factor[k + 1] - factor[k]) / (time[k + 1] - time[k]);
    const double rounding = 1e-9 * std::max(std::abs(before), std::abs(after));
    if (!(std::abs(after - before) <= rounding)) bends.push_back(time[k]);
    before = after;
  }
  return bends;
}

double LoadHistory::end_of_step(double t) const {
  const auto [first, last] = std::equal_range(time.begin(), time.end(), t);
  return last - first > 1 ? std::nextafter(t, -std::numeric_limits<double>::infinity()) : t;
}

}  // namespace trammel::solver
