#include "solver/time/load_history.h"

#include <algorithm>

namespace trammel::solver {

double LoadHistory::at(double t) const {
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  const auto k = static_cast<std::size_t>(next - time.begin());
  if (k == 0) return factor.front();
  if (next == time.end()) return factor.back();
  const double share = (t - time[k - 1]) / (time[k] - time[k - 1]);
  return factor[k - 1] * (1 - share) + factor[k] * share;
}

}  // namespace trammel::solver
