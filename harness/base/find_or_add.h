#pragma once

#include <algorithm>
#include <functional>
#include <ranges>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace trammel::harness {

/// Returns true if an item, or the projection of an item, equals the value. std::string is
/// excluded, so that another function `contains` can search for a substring.
template <typename Range, typename Value, typename Projection = std::identity>
requires(!std::is_same_v<Range, std::string>) bool contains(const Range& range, const Value& value,
                                                            Projection projection = {}) {
  return std::ranges::find(range, value, projection) != std::ranges::end(range);
}

/// Returns the first item that satisfies the predicate `is_match`. If no item satisfies it, appends
/// `fresh` and returns the new item.
template <typename Item, typename Is>
Item& find_or_add(std::vector<Item>& items, Is is_match, Item fresh) {
  const auto found = std::ranges::find_if(items, std::move(is_match));
  return found == items.end() ? items.emplace_back(std::move(fresh)) : *found;
}

}  // namespace trammel::harness
