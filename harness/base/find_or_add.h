#pragma once

#include <algorithm>
#include <concepts>
#include <ranges>
#include <utility>
#include <vector>

namespace trammel::harness {

template <typename Range, typename Value>
requires std::equality_comparable_with<std::ranges::range_value_t<Range>, Value>
bool contains(const Range& range, const Value& value) {
  return std::ranges::find(range, value) != std::ranges::end(range);
}

/// Returns the first item that satisfies the predicate `is_match`. If there is none, appends
/// `fresh` and returns it.
template <typename Item, typename Is>
Item& find_or_add(std::vector<Item>& items, Is is_match, Item fresh) {
  const auto found = std::ranges::find_if(items, std::move(is_match));
  return found == items.end() ? items.emplace_back(std::move(fresh)) : *found;
}

}  // namespace trammel::harness
