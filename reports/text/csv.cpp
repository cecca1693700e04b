#include "reports/text/csv.h"

#include "reports/text/number.h"

namespace trammel::reports {

namespace {

std::string gnuplot_string(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    out += c;
    if (c == '"') out += c;
  }
  return out + '"';
}

std::string written(const Table::Cell& value) {
  if (const auto* number = std::get_if<double>(&value)) return shortest(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return gnuplot_string(*text);
  return "";
}

}  // namespace

Table::Cell cell(const std::optional<double>& number) {
  if (number) return *number;
  return std::monostate{};
}

std::string to_csv(const Table& table) {
  std::string out;
  for (std::size_t i = 0; i < table.heads.size(); ++i)
    out += (i ? "," : "") + gnuplot_string(table.heads[i]);
  out += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) out += (i ? "," : "") + written(row[i]);
    out += '\n';
  }
  return out;
}

}  // namespace trammel::reports
