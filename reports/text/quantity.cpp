#include "reports/text/quantity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "reports/text/number.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

/// Longest first, so that N_m is not read as m.
constexpr std::array<std::pair<const char*, const char*>, 33> kUnits = {{
    {"Hz_m3_per_kg", "Hz·m³/kg"},
    {"N_m_per_rad", "N·m/rad"},
    {"rad_per_s2", "rad/s²"},
    {"rad_per_s", "rad/s"},
    {"N_per_m2", "N/m²"},
    {"N_per_m", "N/m"},
    {"m_per_s2", "m/s²"},
    {"m_per_s", "m/s"},
    {"m_per_N", "m/N"},
    {"Hz_rad_per_N_m", "Hz·rad/(N·m)"},
    {"Hz_per_kg_m2", "Hz/(kg·m²)"},
    {"Hz_per_rad", "Hz/rad"},
    {"Hz_per_kg", "Hz/kg"},
    {"Hz_per_Pa", "Hz/Pa"},
    {"Hz_per_m", "Hz/m"},
    {"kg_per_m3", "kg/m³"},
    {"rad_s", "rad/s"},
    {"per_s", "1/s"},
    {"kg_m2", "kg·m²"},
    {"percent", "%"},
    {"N_m", "N·m"},
    {"Hz", "Hz"},
    {"Pa", "Pa"},
    {"rad", "rad"},
    {"kg", "kg"},
    {"m2", "m²"},
    {"m4", "m⁴"},
    {"deg", "°"},
    {"N", "N"},
    {"s", "s"},
    {"m", "m"},
    {"J", "J"},
    {"W", "W"},
}};

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string words(std::string name) {
  name = spaced(name);
  for (const char* direction : {" x", " y"})
    if (ends_with(name, direction))
      return std::string(direction + 1) + " " + name.substr(0, name.size() - 2);
  return name;
}

/// Units to which an SI prefix can be put in front, whatever they are multiplied with.
bool takes_prefix(const std::string& unit) {
  static const std::array<const char*, 10> plain = {"m",   "N",  "Pa", "s", "Hz",
                                                    "N·m", "kg", "J",  "W", "rad"};
  return std::ranges::find(plain, unit) != plain.end();
}

/// Whether what follows the colon is the name of a quantity in turn, be it of the whole model:
/// relative_error:frequency_Hz.
bool is_of_a_quantity(const std::string& base) {
  static const std::array<const char*, 4> names = {"relative_error", "roundoff",
                                                   "error_over_roundoff", "min_error_at"};
  return std::ranges::find(names, base) != names.end();
}

}  // namespace

std::string display_unit(const std::string& unit) {
  if (unit == "1") return "";
  for (const auto& [key, people] : kUnits)
    if (unit == key) return people;
  std::string people;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    if (unit[i] == ' ') {
      people += "·";
    } else if (unit[i] == '^' && i + 1 < unit.size() && unit[i + 1] >= '2' && unit[i + 1] <= '4') {
      constexpr std::array<const char*, 3> powers = {"²", "³", "⁴"};
      people += powers[unit[++i] - '2'];
    } else {
      people += unit[i];
    }
  }
  return people;
}

QuantityLabel parse_quantity(const std::string& name) {
  QuantityLabel quantity;
  const std::size_t colon = name.find(':');
  std::string base = name.substr(0, colon);
  if (colon != std::string::npos) quantity.subject = name.substr(colon + 1);
  // frequency_Hz:1 along a path or over a range of speeds.
  if (quantity.subject.find_first_not_of("0123456789") == std::string::npos &&
      !quantity.subject.empty()) {
    quantity.subject.insert(0, "mode ");
  } else if (quantity.subject.find(':') != std::string::npos || is_of_a_quantity(base)) {
    quantity.subject = to_text(parse_quantity(quantity.subject));
  }
  for (const auto& [key, people] : kUnits) {
    if (!ends_with(base, std::string("_") + key)) continue;
    quantity.unit = people;
    base.resize(base.size() - std::string(key).size() - 1);
    break;
  }
  quantity.label = base == "error_over_roundoff" ? "error over promised round-off" : words(base);
  return quantity;
}

std::string to_text(const QuantityLabel& quantity) {
  return quantity.subject.empty() ? quantity.label : quantity.label + " of " + quantity.subject;
}

Scale readable_scale(const std::string& unit, double largest) {
  if (largest <= 0 || !std::isfinite(largest)) return {1, unit};
  if (takes_prefix(unit) && unit != "kg") {
    // Lengths are spoken of in metres from half a metre up, in millimetres below.
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

std::string axis_label(const std::string& label, const std::string& unit) {
  return unit.empty() ? label : label + " (" + unit + ")";
}

}  // namespace trammel::reports
