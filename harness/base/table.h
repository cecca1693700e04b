#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace trammel::harness {

/// Columns of text for a terminal: the first ones flush left, numbers flush right.
class Table {
 public:
  /// @param columns  heads; one that starts with '>' is flush right
  explicit Table(std::vector<std::string> columns);
  void add(std::vector<std::string> row);
  [[nodiscard]] bool empty() const { return rows_.empty(); }
  void print(std::ostream& out, const std::string& indent = "") const;

 private:
  std::vector<std::string> headers_;
  std::vector<bool> right_aligned_;
  std::vector<std::vector<std::string>> rows_;
};

/// Text broken at spaces to a width, each line indented.
[[nodiscard]] std::string wrapped(const std::string& text, const std::string& indent,
                                  std::size_t width = 96);

}  // namespace trammel::harness
