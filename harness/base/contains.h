#pragma once

#include <algorithm>

namespace trammel::harness {

template <typename Range, typename Value>
bool contains(const Range& range, const Value& value) {
  return std::ranges::find(range, value) != std::ranges::end(range);
}

}  // namespace trammel::harness
