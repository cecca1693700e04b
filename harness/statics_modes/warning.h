#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"

namespace trammel::harness {

/// What to know of a result that is solved: a quantity has left the range in which it means what it
/// says.
struct Warning {
  std::string quantity;  ///< "the largest rotation"
  double value = 0;
  std::string unit;     ///< "" or " rad"
  std::string meaning;  ///< what holds up to where, and why

  [[nodiscard]] std::string text() const {
    return quantity + " is " + rounded(value, 3) + unit + ": " + meaning;
  }
};

/// Of two of one quantity, as at two points of a path, the larger stays.
inline void add_warning(std::vector<Warning>& all, const Warning& one) {
  const auto is_same = [&](const Warning& other) {
    return other.quantity == one.quantity && other.meaning == one.meaning;
  };
  Warning& same = find_or_add(all, is_same, one);
  same.value = std::max(same.value, one.value);
}

inline void add_warnings(std::vector<Warning>& all, const std::vector<Warning>& more) {
  for (const Warning& one : more) add_warning(all, one);
}

}  // namespace trammel::harness
