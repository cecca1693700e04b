#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "harness/base/json.h"

namespace trammel::harness {

/// A column of rows: its key in JSON and CSV, and its head in a table for a terminal.
struct Column {
  std::string key, head;
  int digits;    ///< significant digits in the table; 0: of a list its length alone
  double scale;  ///< of numbers in the table: 100 for percent
  bool is_right_aligned = false;

  /// @param head  the key if empty; text below a head that starts with '>' is right aligned, as
  ///              numbers always are
  Column(const char* key, const std::string& head = "", int digits = 6, double scale = 1);
};

/// What a command prints: rows of cells with the same columns in three forms.
class Rows {
 public:
  explicit Rows(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// @param rows  an array of objects, of which the columns select keys
  Rows(std::vector<Column> columns, const Json& rows);

  /// @param cells  texts, numbers, truth values, lists of them or null, one a column
  void add(std::vector<Json> cells);
  [[nodiscard]] bool empty() const { return rows_.empty(); }

  /// A table with aligned columns.
  void print(std::ostream& out, const std::string& indent = "") const;
  /// An array of objects.
  [[nodiscard]] Json json() const;
  /// A line of keys, then a line for each row (RFC 4180), with all digits of the numbers.
  [[nodiscard]] std::string csv() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<Json>> rows_;
};

/// Text broken at spaces to a width, each line indented.
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& indent,
                                  std::size_t width = 96);

/// "1 case", "2 cases"
[[nodiscard]] std::string count_of(std::size_t count, const std::string& noun);

}  // namespace trammel::harness
