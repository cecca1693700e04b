#pragma once

#include <algorithm>
#include <utility>
#include <vector>

namespace trammel::harness {

/// The first item of which `is` holds; where there is none `fresh` becomes the last.
template <typename Item, typename Is>
Item& find_or_add(std::vector<Item>& items, Is is, Item fresh) {
  const auto found = std::ranges::find_if(items, std::move(is));
  return found == items.end() ? items.emplace_back(std::move(fresh)) : *found;
}

}  // namespace trammel::harness
