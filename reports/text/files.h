#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/base/json.h"

/// Reading and writing of text files, conversion of tables to CSV, and templates of pages.
namespace trammel::reports {

using harness::number_or_null;

/// Returns the text of a file. @throws std::system_error  if the file cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);
/// Writes a temporary file and renames it to `path`, so that `path` is never an incomplete file. If
/// `path` is a symbolic link, the link is replaced.
/// @throws std::system_error  if the file cannot be written.
void write_file(const std::filesystem::path& path, const std::string& text);

/// Moves all files below the folder `from` to the same relative paths below `to`; moves the file
/// `last_moved` after all others. Then removes `from`, and the files of `obsolete` (paths below
/// `to`) that were not replaced. Symbolic links are replaced and not followed. Signals that end the
/// program are blocked during the replacement.
/// @throws std::system_error  before any file is moved, if a folder has the name of a file or a
/// file has the name of a folder.
void replace_files(const std::filesystem::path& from, const std::filesystem::path& to,
                   const std::string& last_moved,
                   const std::vector<std::filesystem::path>& obsolete);

/// A table for a CSV file (RFC 4180, UTF-8), with units in the column headings.
struct Table {
  std::vector<std::string> heads;
  std::vector<std::vector<harness::Json>> rows;
  int digits = 0;  ///< significant digits of numbers; 0: all
};

/// Returns the table as CSV. Numbers with all digits read back as the same doubles. Missing values
/// are empty cells. Texts that a spreadsheet would interpret as formulas start with an apostrophe.
[[nodiscard]] std::string to_csv(const Table& table);

/// Returns the text of a file of the folder templates/, which is compiled into the program.
/// @throws std::logic_error  if there is no such file.
[[nodiscard]] const std::string& template_text(const std::string& name);

}  // namespace trammel::reports
