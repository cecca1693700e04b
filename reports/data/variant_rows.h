#pragma once

#include <functional>
#include <map>
#include <string>

#include "reports/text/html.h"

namespace trammel::reports {

/// What tables of variants against the entries of a reference have in common.

/// Heads of the columns: each entry, with what is printed for it.
/// @param word  before the number of an entry: "mode "
[[nodiscard]] Data target_columns(const std::map<int, double>& targets, const std::string& word);

/// A cell for each target; `make` gets nullptr where a row has no such entry.
template <typename Item, typename Make>
[[nodiscard]] Data target_cells(const std::map<int, double>& targets,
                                const std::map<int, const Item*>& entries, Make make) {
  return list_of(targets, [&](const auto& target) {
    const auto found = entries.find(target.first);
    return make(found == entries.end() ? nullptr : found->second);
  });
}

/// Rows, and under `folded` those beyond `max_unfolded` where they are more than three.
void set_variant_rows(Data& table, std::size_t rows, std::size_t max_unfolded,
                      const std::function<Data(std::size_t)>& row);

}  // namespace trammel::reports
