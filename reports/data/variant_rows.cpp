#include "reports/data/variant_rows.h"

#include "reports/text/number.h"

namespace trammel::reports {

Data target_columns(const std::map<int, double>& targets, const std::string& word) {
  return list_of(targets, [&](const auto& target) {
    return object({{"entry", word + std::to_string(target.first + 1)},
                   {"target", trimmed(target.second, 6)}});
  });
}

void set_variant_rows(Data& table, std::size_t rows, std::size_t max_unfolded,
                      const std::function<Data(std::size_t)>& row) {
  const std::size_t shown = rows > max_unfolded + 3 ? max_unfolded : rows;
  Data unfolded = list(), folded = list();
  for (std::size_t i = 0; i < rows; ++i) (i < shown ? unfolded : folded).push_back(row(i));
  set(table, {{"rows", unfolded},
              {"folded", folded},
              {"folded_title", shown == rows ? "" : count(rows - shown, "further variant")}});
}

}  // namespace trammel::reports
