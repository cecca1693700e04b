#include "reports/text/number.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <regex>
#include <sstream>

namespace trammel::reports {

namespace {

void drop_trailing_zeros(std::string& text) {
  if (text.find('.') == std::string::npos) return;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
}

std::string typeset_minus_sign(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, "\u2212");
  return text;
}

std::string scientific_notation(double x, int digits, bool trim) {
  const std::string text = fmt::format("{:.{}e}", x, digits - 1);
  const std::size_t e = text.find('e');
  std::string mantissa = text.substr(0, e);
  if (trim) drop_trailing_zeros(mantissa);
  const std::string power = power_of_ten(std::stoi(text.substr(e + 1)));
  if (mantissa == "1") return power;
  if (mantissa == "-1") return "\u2212" + power;
  return typeset_minus_sign(mantissa) + "\u202f×\u202f" + power;
}

std::string written(double x, int digits, bool trim) {
  if (!std::isfinite(x)) return std::isnan(x) ? "not a number" : (x > 0 ? "∞" : "\u2212∞");
  if (x == 0) return "0";
  // Rounding can change the decimal exponent: 9.9996 with four digits is 10.00.
  const std::string rounded = fmt::format("{:.{}e}", x, digits - 1);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  if (exponent < -4 || exponent >= std::max(6, digits)) return scientific_notation(x, digits, trim);
  std::string text = fmt::format("{:.{}f}", x, std::max(0, digits - 1 - exponent));
  if (trim) drop_trailing_zeros(text);
  return typeset_minus_sign(text);
}

}  // namespace

std::string rounded_text(double x, int digits) {
  return written(x, digits, false);
}

std::string trimmed(double x, int digits) {
  return written(x, digits, true);
}

std::string number_with_sign(double x, int digits) {
  return (x > 0 ? "+" : "") + written(x, digits, true);
}

std::string percent_text(double x, int digits, bool sign) {
  const auto text = [&](double value) {
    return sign ? number_with_sign(value, digits) : trimmed(value, digits);
  };
  if (x == 0) return "0";
  if (std::abs(x) < 1e-5) return text(x);
  return text(100 * x) + "\u202f%";
}

int distinguishing_digits(double a, double b) {
  const double scale = std::max(std::abs(a), std::abs(b));
  if (scale == 0 || a == b || !std::isfinite(a) || !std::isfinite(b)) return 6;
  const double digits = std::ceil(-std::log10(std::abs(a - b) / scale)) + 1;
  return digits > 10 ? 6 : static_cast<int>(std::max(digits, 4.0));
}

std::string shortest_decimal(double x, int digits) {
  return fmt::format("{:.{}g}", x, digits);
}

std::string power_of_ten(int exponent) {
  static constexpr std::array digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
  return out;
}

std::string with_powers_of_ten(const std::string& text) {
  static const std::regex number(R"((?:^|\W)(\d+(?:\.\d*)?)[eE]([-+]?\d+)(?!\w))");
  auto from = text.cbegin();
  std::string out;
  for (std::sregex_iterator it(text.begin(), text.end(), number), end; it != end; ++it) {
    const std::ssub_match mantissa = (*it)[1];
    out.append(from, mantissa.first);
    if (mantissa != "1") out += mantissa.str() + "\u202f×\u202f";
    out += power_of_ten(std::stoi((*it)[2]));
    from = (*it)[0].second;
  }
  return out.append(from, text.cend());
}

std::string count(std::size_t n, const std::string& singular, const std::string& plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : (plural.empty() ? singular + "s" : plural));
}

std::string duration(double seconds) {
  if (seconds < 1e-3) return trimmed(1e6 * seconds, 2) + " µs";
  if (seconds < 1) return trimmed(1e3 * seconds, 3) + " ms";
  if (seconds < 100) return trimmed(seconds, 3) + " s";
  const long total = std::lround(seconds);
  return std::to_string(total / 60) + " min " + std::to_string(total % 60) + " s";
}

std::string length_text(double length_m) {
  return length_m < 0.2 ? trimmed(1000 * length_m, 3) + "\u202fmm"
                        : trimmed(length_m, 3) + "\u202fm";
}

std::string text_or_dash(harness::Number x, int digits) {
  return x ? trimmed(*x, digits) : "–";
}

std::string replace_separators(std::string name) {
  std::ranges::replace_if(
      name, [](char c) { return c == '-' || c == '_'; }, ' ');
  return name;
}

std::string capitalized(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] -= 'a' - 'A';
  return text;
}

std::string limits_text(const std::string& low, const std::string& high) {
  return low == high ? low : low + " to " + high;
}

void add_item(std::string& list, const std::string& item, const std::string& separator) {
  list += (list.empty() ? "" : separator) + item;
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace trammel::reports
