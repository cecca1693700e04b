#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "harness/base/json.h"

namespace trammel::harness {

/// Column of a table: its key in JSON and CSV, and its heading on a terminal.
struct Column {
  std::string key, head;
  int digits;    ///< significant digits in the table; 0: print only the length of a list
  double scale;  ///< factor of numbers in the table: 100 for percent
  bool is_right_aligned = false;

  /// @param head  heading of the column, by default the key. Text below a heading that starts with
  ///   '>' is aligned to the right. Numbers are always aligned to the right.
  Column(const char* key, const std::string& head = "", int digits = 6, double scale = 1);
};

/// Output of a command: rows of cells with the same columns, in three formats (text table, JSON and
/// CSV).
class Rows {
 public:
  explicit Rows(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// @param rows  an array of objects, one per row; each column shows the value of its key
  Rows(std::vector<Column> columns, const Json& rows);

  /// @param cells  one cell per column: text, number, truth value, null, or a list of such values
  void add(std::vector<Json> cells);
  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// Prints a table with aligned columns, without columns that have no values.
  void print(std::ostream& out, const std::string& indent = "") const;
  /// Returns the rows as a JSON array with one object per row.
  [[nodiscard]] Json json() const;
  /// Returns a line of keys, then a line for each row (RFC 4180).
  /// @param digits  significant digits of the numbers; 0: all
  [[nodiscard]] std::string csv(int digits = 0) const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Json>> rows_;
};

/// Returns a text as a cell of a CSV file (RFC 4180). A text that a spreadsheet would interpret as
/// a formula starts with an apostrophe. Control characters other than line breaks become spaces.
[[nodiscard]] std::string quote_csv_text(const std::string& text);

/// Breaks a text at spaces into lines of limited width, and indents each line.
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& indent,
                                  std::size_t width = 96);

/// Returns a count with its noun in the singular or plural: "1 case", "2 cases".
[[nodiscard]] std::string count_of(std::size_t count, const std::string& noun);

}  // namespace trammel::harness
