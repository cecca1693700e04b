#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"

namespace trammel::harness {

/// Warning that belongs to a solved result: a quantity is outside its validity range.
struct Warning {
  std::string quantity;  ///< subject of the text: "the largest rotation"
  double value = 0;
  std::string unit;     ///< unit with a leading space: " rad"
  std::string meaning;  ///< validity range of the quantity, and reason for the range

  [[nodiscard]] std::string text() const {
    return quantity + " is " + rounded(value, 3) + unit + ": " + meaning;
  }
};

/// Adds a warning. Of two warnings about the same quantity, for example at two points of a path,
/// only the warning with the larger value is kept.
inline void add_warning(std::vector<Warning>& warnings, const Warning& warning) {
  const auto is_same = [&](const Warning& other) {
    return other.quantity == warning.quantity && other.meaning == warning.meaning;
  };
  Warning& same = find_or_add(warnings, is_same, warning);
  same.value = std::max(same.value, warning.value);
}

inline void add_warnings(std::vector<Warning>& warnings, const std::vector<Warning>& more) {
  for (const Warning& one : more) add_warning(warnings, one);
}

}  // namespace trammel::harness
