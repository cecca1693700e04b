#pragma once

#include <algorithm>
#include <limits>

#include "harness/base/number.h"

namespace trammel::reports {

/// Range from the lowest to the highest number that was passed to `cover`.
struct Interval {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void cover(harness::Number x) {
    if (!x) return;
    low = std::min(low, *x);
    high = std::max(high, *x);
  }
  /// Extends the range so that it includes x / factor and x * factor, for a positive number x.
  void cover_around(double x, double factor) {
    cover(x / factor);
    cover(x * factor);
  }
  void widen(double by) {
    low -= by;
    high += by;
  }
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double length() const { return high - low; }
};

}  // namespace trammel::reports
