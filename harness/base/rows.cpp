#include "harness/base/rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <sstream>

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

std::size_t text_width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string table_cell(const Json& cell, const Column& column) {
  if (cell.is_null()) return "";
  if (cell.is_string()) return cell.get<std::string>();
  if (cell.is_boolean()) return cell.get<bool>() ? "yes" : "no";
  if (cell.is_number_float()) return rounded(column.scale * cell.get<double>(), column.digits);
  if (!cell.is_array()) return cell.dump();
  if (column.digits == 0) return std::to_string(cell.size());
  std::vector<std::string> items;
  for (const Json& item : cell) items.push_back(table_cell(item, column));
  return fmt::format("{}", fmt::join(items, ", "));
}

/// Returns true if a spreadsheet would interpret the text as a formula.
bool is_formula(const std::string& text) {
  char* end = nullptr;
  (void)std::strtod(text.c_str(), &end);
  return text.find_first_of("=+-@\t\r") == 0 && *end != '\0';
}

std::string csv_cell_text(const Json& cell, int digits) {
  if (cell.is_null()) return "";
  if (cell.is_number_float() && digits > 0) return rounded(cell.get<double>(), digits);
  if (cell.is_number_float()) return shortest_decimal(cell.get<double>());
  return cell.is_string() || cell.is_array() ? quote_csv_text(table_cell(cell, "")) : cell.dump();
}

}  // namespace

Column::Column(const char* its_key, const std::string& its_head, int its_digits, double its_scale)
    : key(its_key), head(its_head.empty() ? key : its_head), digits(its_digits), scale(its_scale) {
  is_right_aligned = head.starts_with('>');
  if (is_right_aligned) head.erase(0, 1);
}

Rows::Rows(std::vector<Column> columns, const Json& rows) : columns_(std::move(columns)) {
  for (const Json& row : rows) {
    std::vector<Json> cells;
    for (const Column& column : columns_) cells.push_back(row.value(column.key, Json()));
    add(std::move(cells));
  }
}

void Rows::add(std::vector<Json> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

void Rows::print(std::ostream& out, const std::string& indent) const {
  std::vector<std::string> lines(rows_.size() + 1, indent);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto is_missing = [&](const std::vector<Json>& row) { return row[c].is_null(); };
    if (!rows_.empty() && std::ranges::all_of(rows_, is_missing)) continue;
    std::vector<std::string> cells = {columns_[c].head};
    bool right = columns_[c].is_right_aligned;
    for (const std::vector<Json>& row : rows_) {
      cells.push_back(table_cell(row[c], columns_[c]));
      right = right || row[c].is_number();
    }
    std::size_t width = 0;
    for (const std::string& cell : cells) width = std::max(width, text_width(cell));
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string space(width - text_width(cells[i]), ' ');
      lines[i] += (lines[i] == indent ? "" : "  ") + (right ? space + cells[i] : cells[i] + space);
    }
  }
  for (std::string& line : lines) out << line.erase(line.find_last_not_of(' ') + 1) << '\n';
}

Json Rows::json() const {
  Json all = Json::array();
  for (const std::vector<Json>& row : rows_) {
    Json& object = all.emplace_back(Json::object());
    for (std::size_t c = 0; c < columns_.size(); ++c) object[columns_[c].key] = row[c];
  }
  return all;
}

std::string Rows::csv(int digits) const {
  std::string text;
  const auto add_line = [&](const auto& cells, const auto& text_of) {
    for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? "," : "") + text_of(cells[c]);
    text += '\n';
  };
  add_line(columns_, [](const Column& column) { return quote_csv_text(column.key); });
  for (const std::vector<Json>& row : rows_)
    add_line(row, [&](const Json& cell) { return csv_cell_text(cell, digits); });
  return text;
}

std::string quote_csv_text(const std::string& text) {
  const bool is_quoted = text.find_first_of(",\"\r\n") != std::string::npos;
  std::string out = std::string(is_quoted ? "\"" : "") + (is_formula(text) ? "'" : "");
  for (const char c : text) {
    out += std::iscntrl(static_cast<unsigned char>(c)) != 0 && c != '\n' ? ' ' : c;
    if (c == '"') out += c;
  }
  return is_quoted ? out + '"' : out;
}

std::string wrapped(const std::string& text, const std::string& indent, std::size_t width) {
  std::istringstream words(text);
  std::string all, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && indent.size() + line.size() + 1 + word.size() > width) {
      all += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return line.empty() ? all : all + indent + line + "\n";
}

std::string count_of(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace trammel::harness
