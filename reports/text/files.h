#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "harness/base/number.h"

/// Files: their texts, tables as CSV, and the templates that are built into the program.
namespace trammel::reports {

/// Whole files as text. @throws std::system_error  naming the file: the fault lies outside.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);
/// All of it or nothing: a file of its own name, renamed at the end. A link is replaced.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Moves every file below `from` to the same place below `to`, the one named `last` after all
/// others, then removes `obsolete` (below `to`) where it was not replaced, and `from`. Links in the
/// way are replaced, not followed; signals that end the program wait.
/// @throws std::system_error  naming what is in the way, before anything is moved.
void replace_files(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::string& last, const std::vector<std::filesystem::path>& obsolete);

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

/// The text of a file of templates/, built into the program. @throws std::logic_error if there is
/// no such file.
[[nodiscard]] const std::string& template_text(const std::string& name);

}  // namespace trammel::reports
