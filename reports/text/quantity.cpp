#include "reports/text/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <utility>

#include "harness/base/find_or_add.h"
#include "harness/base/quantity.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

std::string words(const std::string& key) {
  std::string name = replace_separators(key);
  for (const char* direction : {" x", " y"})
    if (name.ends_with(direction))
      return std::string(direction + 1) + " " + name.substr(0, name.size() - 2);
  return name;
}

}  // namespace

std::string display_unit(const std::string& unit) {
  if (unit == "1") return "";
  if (unit == "deg") return "°";
  std::string typeset;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (unit[i] == ' ') {
      typeset += "·";
    } else if (unit[i] == '^' && i + 1 < unit.size() && unit[i + 1] >= '2' && unit[i + 1] <= '4') {
      constexpr std::array<const char*, 3> powers = {"²", "³", "⁴"};
      typeset += powers[unit[++i] - '2'];
    } else {
      typeset += unit[i];
    }
  }
  return typeset;
}

QuantityLabel parse_quantity(const std::string& name) {
  // The name of another quantity follows the colon, as in relative_error:frequency_Hz.
  static const auto of_others =
      words_in("relative_error roundoff error_over_roundoff min_error_at");
  QuantityLabel quantity;
  const std::size_t colon = name.find(':');
  const auto [base, unit] = harness::split_name(name);
  quantity.unit = display_unit(unit);
  if (colon != std::string::npos) quantity.subject = name.substr(colon + 1);
  // A number after the colon is a mode number: frequency_Hz:1 contains the frequency of mode 1 at
  // each point of a path or at each speed.
  if (quantity.subject.find_first_not_of("0123456789") == std::string::npos &&
      !quantity.subject.empty()) {
    quantity.subject.insert(0, "mode ");
  } else if (quantity.subject.find(':') != std::string::npos ||
             harness::contains(of_others, base)) {
    quantity.subject = to_text(parse_quantity(quantity.subject));
  }
  quantity.label =
      base == "error_over_roundoff" ? "error over estimated round-off error" : words(base);
  return quantity;
}

std::string to_text(const QuantityLabel& quantity) {
  return quantity.subject.empty() ? quantity.label : quantity.label + " of " + quantity.subject;
}

Scale readable_scale(const std::string& unit, double largest) {
  if (largest <= 0 || !std::isfinite(largest)) return {1, unit};
  if (harness::contains(words_in("m N Pa s Hz N·m J W rad"), unit)) {  // units with SI prefixes
    // Lengths are in meters from 0.2 m upward, and in millimeters below.
    const double small = unit == "m" ? 0.2 : 1;
    static const std::array<std::pair<double, const char*>, 6> prefixes = {
        {{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}}};
    for (const auto& [size, prefix] : prefixes) {
      if (unit == "m" && size > 1) continue;
      if (largest >= size * (size == 1 ? small : 1)) return {1 / size, prefix + unit};
    }
  } else if (largest >= 1e-2 && largest < 1e4) {
    return {1, unit};
  }
  const int exponent = static_cast<int>(std::floor(std::log10(largest)));
  return {std::pow(10.0, -exponent), power_of_ten(exponent) + (unit.empty() ? "" : " " + unit)};
}

std::string math_html(const std::string& formula) {
  static const std::regex token(R"(([A-Za-z]+|\d+|\S)(?:\^(\d+))?)");
  std::string out = "<math>";
  for (std::sregex_iterator it(formula.begin(), formula.end(), token), end; it != end; ++it) {
    const std::string word = (*it)[1], power = (*it)[2];
    const std::string symbol = word == "pi" ? "π" : word == "kappa" ? "κ" : word;
    const bool letters = std::isalpha(static_cast<unsigned char>(word[0])) != 0;
    const bool text = letters && symbol == word && word.size() > 1;
    const std::string base = text      ? "<mtext>&#160;" + word + "&#160;</mtext>"
                             : letters ? "<mi>" + symbol + "</mi>"
                                       : "<mo>" + symbol + "</mo>";
    out += power.empty() ? base : "<msup>" + base + "<mn>" + power + "</mn></msup>";
  }
  return out + "</math>";
}

std::string axis_label(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + " (" + unit + ")";
}

}  // namespace trammel::reports
