#include "reports/drawing/plot_script.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxKeyCharacters = 38;  ///< longer titles do not fit into the legend

/// Returns the numbers of a data row as text for gnuplot. If a number is not finite, the text is
/// empty, which interrupts the curve.
std::string data_row_text(const std::vector<double>& row) {
  std::string out;
  for (const double x : row) {
    if (!std::isfinite(x)) return "";
    out += (out.empty() ? "" : " ") + shortest_decimal(x, kSampleDigits);
  }
  return out;
}

/// Returns true if a byte is the first byte of a UTF-8 character.
bool starts_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
}

std::string titled(const std::string& title) {
  return title.empty()
             ? " notitle"
             : " title " + gnuplot_string(shortened(with_powers_of_ten(title), kMaxKeyCharacters));
}

}  // namespace

std::string gnuplot_string(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? "’" : std::string(1, is_control(c) ? ' ' : c);
  return out + '\'';
}

std::string gnuplot_path(const std::filesystem::path& path) {
  std::string out = "\"";
  for (const char c : std::filesystem::absolute(path).string()) {
    // Digits are escaped, too. Gnuplot would read a digit after an octal escape as a part of the
    // escape.
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '/' || c == '.' || c == '-') {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += {'\\', static_cast<char>('0' + byte / 64), static_cast<char>('0' + byte / 8 % 8),
            static_cast<char>('0' + byte % 8)};
  }
  return out + '"';
}

std::string tic(const std::string& text, double at) {
  std::string format;  // gnuplot interprets tick labels as printf formats
  for (const char c : text) format += c == '%' ? "%%" : std::string(1, c);
  return gnuplot_string(format) + " " + shortest_decimal(at);
}

std::size_t character_count(const std::string& utf8) {
  return static_cast<std::size_t>(std::ranges::count_if(utf8, starts_character));
}

std::string shortened(const std::string& text, std::size_t max_characters) {
  if (character_count(text) <= max_characters) return text;
  std::size_t seen = 0, end = 0;
  while (end < text.size() && (seen += starts_character(text[end])) < max_characters) ++end;
  return text.substr(0, end) + "…";
}

std::string lc(const std::string& color) {
  return " lc rgb " + gnuplot_string(color);
}

void PlotScript::command(const std::string& line) {
  commands_ += line + '\n';
}

void PlotScript::curve(const Rows& rows, const std::string& style, const std::string& title) {
  if (rows.empty()) return;
  const std::string block = "$d" + std::to_string(blocks_++);
  command(block + " << EOD");
  for (const auto& row : rows) command(data_row_text(row));
  command("EOD");
  curves_.push_back(block + " " + style + titled(title));
}

void PlotScript::key_entry(const std::string& style, const std::string& title) {
  curves_.push_back("keyentry " + style + titled(title));
}

void PlotScript::label(const std::string& text, const std::string& place) {
  command("set label " + gnuplot_string(with_powers_of_ten(text)) + " at " + place);
}

void PlotScript::plot() {
  std::string line = "plot ";
  for (std::size_t i = 0; i < curves_.size(); ++i) line += (i ? ", " : "") + curves_[i];
  command(line);
  curves_.clear();
}

int PlotScript::place_key_below(const std::vector<std::string>& titles, std::size_t max_columns) {
  std::size_t longest = 1;
  for (const std::string& title : titles)
    longest = std::max(longest, std::min(character_count(title), kMaxKeyCharacters));
  const std::size_t columns = std::clamp<std::size_t>(56 / (longest + 7), 1, max_columns);
  command("set key maxcols " + std::to_string(columns));
  return 8 + 22 * static_cast<int>((titles.size() + columns - 1) / columns);
}

void PlotScript::range(const std::string& axis, double low, double high) {
  command("set " + axis + "range [" + shortest_decimal(low) + ":" + shortest_decimal(high) + "]");
}

void PlotScript::axis_label(const std::string& axis, const std::string& text) {
  command("set " + axis + "label " + gnuplot_string(text));
}

void PlotScript::log_axis(const std::string& axis, double low, double high) {
  constexpr int kMaxLabels = 7;
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(high) - 1e-9));
  int step = 1;
  while ((last - first) / step + 1 > kMaxLabels) ++step;
  command("set logscale " + axis);
  range(axis, std::pow(10.0, first), std::pow(10.0, last));
  std::string tics;
  for (int exponent = first; exponent <= last; ++exponent)
    if ((last - exponent) % step == 0)
      add_item(tics, tic(power_of_ten(exponent), std::pow(10.0, exponent)));
  command("set " + axis + "tics (" + tics + ")");
}

}  // namespace trammel::reports
