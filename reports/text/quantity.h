#pragma once

#include <string>

namespace trammel::reports {

/// Parts of a quantity's name: displacement_x_m:P is the "x displacement" of "P" in "m".
/// frequency_Hz:1 is the "frequency" of "mode 1". peak_time_s:displacement_y_m:M is the "peak time"
/// of the "y displacement of M".
struct QuantityLabel {
  std::string label, subject, unit;  ///< typeset unit: N·m, rad/s; empty if dimensionless
};

[[nodiscard]] QuantityLabel parse_quantity(const std::string& name);

/// Returns a quantity as text without its unit: "x displacement of P".
[[nodiscard]] std::string to_text(const QuantityLabel& quantity);

/// Converts a unit in the notation of reference files (N m, kg m^2) to a typeset unit (N·m, kg·m²).
[[nodiscard]] std::string display_unit(const std::string& unit);

/// Factor that scales values to the range 1 ... 1000 if the largest is `largest`, and the scaled
/// unit: 0.0081 m becomes 8.1 mm. Units without SI prefixes have a power of ten.
struct Scale {
  double factor = 1;
  std::string unit;
};
[[nodiscard]] Scale readable_scale(const std::string& unit, double largest);

/// Returns a formula, such as "E I k^2 / (kappa G A)", as MathML. A word of several letters is a
/// text, except for the names of Greek letters.
[[nodiscard]] std::string math_html(const std::string& formula);

/// Returns a label followed by its unit: "x displacement of P (mm)".
[[nodiscard]] std::string axis_label(const std::string& label, const std::string& unit);

}  // namespace trammel::reports
