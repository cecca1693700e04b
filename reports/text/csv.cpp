#include <cctype>

#include "reports/text/files.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// What a spreadsheet would take for a formula.
bool is_formula(const std::string& text) {
  const char first = text.empty() ? ' ' : text[0], second = text.size() > 1 ? text[1] : ' ';
  const bool letter = std::isalpha(static_cast<unsigned char>(second)) != 0 || second == '(';
  return first == '=' || first == '+' || first == '@' || first == '\t' || first == '\r' ||
         (first == '-' && letter);
}

/// A formula gets an apostrophe in front; control characters, but line breaks, become spaces.
std::string text_cell(const std::string& text) {
  const bool quoted = text.find_first_of(",\"\r\n") != std::string::npos;
  std::string out = quoted ? "\"" : "";
  if (is_formula(text)) out += '\'';
  for (const char c : text) {
    out += is_control(c) && c != '\n' ? ' ' : c;
    if (c == '"') out += c;
  }
  return quoted ? out + '"' : out;
}

std::string written(const Table::Cell& value, int digits) {
  if (const auto* number = std::get_if<double>(&value))
    return digits > 0 ? shortest(*number, digits) : shortest(*number);
  if (const auto* text = std::get_if<std::string>(&value)) return text_cell(*text);
  return "";
}

}  // namespace

Table::Cell cell(harness::Number number) {
  if (number) return *number;
  return std::monostate{};
}

std::string to_csv(const Table& table) {
  std::string out;
  for (std::size_t i = 0; i < table.heads.size(); ++i)
    out += (i ? "," : "") + text_cell(table.heads[i]);
  out += '\n';
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i)
      out += (i ? "," : "") + written(row[i], table.digits);
    out += '\n';
  }
  return out;
}

}  // namespace trammel::reports
