#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "harness/base/number.h"

/// Text files, tables as CSV, and templates.
namespace trammel::reports {

/// Returns the text of a file. @throws std::system_error  with the name of the file.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);
/// Writes a file through a temporary one, so that it is never incomplete. A link is replaced.
/// @throws std::system_error  with the name of the file.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Moves all files below `from` to the same relative paths below `to`; moves the file `last` after
/// all others. Then removes `from`, and the files of `obsolete` (below `to`) that were not
/// replaced. Links are replaced and not followed. Signals that end the program are blocked
/// meanwhile.
/// @throws std::system_error  with the name of an obstacle, before any file is moved.
void replace_files(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::string& last, const std::vector<std::filesystem::path>& obsolete);

/// A table for a CSV file (RFC 4180, UTF-8), with units in the heads of columns.
struct Table {
  using Cell = std::variant<std::monostate, double, std::string>;

  std::vector<std::string> heads;
  std::vector<std::vector<Cell>> rows;
  int digits = 0;  ///< significant digits of numbers; 0: all
};

[[nodiscard]] Table::Cell cell(harness::Number number);

/// Returns the table as CSV. With all digits, numbers read back as the same doubles. Missing values
/// are empty. Texts that a spreadsheet would interpret as formulas start with an apostrophe.
[[nodiscard]] std::string to_csv(const Table& table);

/// Returns the text of a file of templates/, which is built into the program.
/// @throws std::logic_error  if there is no such file.
[[nodiscard]] const std::string& template_text(const std::string& name);

}  // namespace trammel::reports
