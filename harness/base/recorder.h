#pragma once

#include <string>

#include "harness/base/quantity.h"

namespace trammel::harness {

/// Collects quantities: each call adds one number at the end of its quantity, so that a path ends
/// up with one number a point.
class Recorder {
 public:
  /// @param item  what it belongs to, after the colon; empty: nothing
  void add(const std::string& name, const std::string& item, double value, double roundoff = -1) {
    Quantity& quantity = quantities_[item.empty() ? name : name + ":" + item];
    quantity.values.push_back(value);
    if (roundoff >= 0) quantity.roundoff.push_back(roundoff);
  }
  [[nodiscard]] Quantities take_quantities() { return std::move(quantities_); }

 private:
  Quantities quantities_;
};

}  // namespace trammel::harness
