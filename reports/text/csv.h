#pragma once

#include <string>
#include <variant>
#include <vector>

#include "harness/base/number.h"

namespace trammel::reports {

/// A table with its units in the column heads, as written to a CSV file (RFC 4180, UTF-8).
struct Table {
  using Cell = std::variant<std::monostate, double, std::string>;

  std::vector<std::string> heads;
  std::vector<std::vector<Cell>> rows;
  int digits = 0;  ///< significant ones of its numbers; 0: all
};

[[nodiscard]] Table::Cell cell(harness::Number number);

/// Without a limit of digits, numbers read back as the same doubles. Missing values are empty.
/// Texts that a spreadsheet would compute have an apostrophe in front.
[[nodiscard]] std::string to_csv(const Table& table);

}  // namespace trammel::reports
