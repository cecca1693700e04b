#pragma once

#include <string>

namespace trammel::reports {

/// A quantity's name taken apart: displacement_x_m:P is the "x displacement" of "P" in "m",
/// frequency_Hz:1 the "frequency" of "mode 1", peak_time_s:displacement_y_m:M the "peak time" of
/// the "y displacement of M".
struct QuantityLabel {
  std::string label, subject, unit;  ///< unit for people: N·m, rad/s; empty if dimensionless
};

[[nodiscard]] QuantityLabel parse_quantity(const std::string& name);

/// "x displacement of P".
[[nodiscard]] std::string to_text(const QuantityLabel& quantity);

/// A unit as references write it (N m, kg m^2, rad/s) for people (N·m, kg·m², rad/s).
[[nodiscard]] std::string display_unit(const std::string& unit);

/// The factor that brings values of up to `largest` near 1 ... 1000, and the unit that goes with
/// it: 0.0081 m is 8.1 mm. Where the unit takes no prefix, a power of ten stands in its place.
struct Scale {
  double factor = 1;
  std::string unit;
};
[[nodiscard]] Scale readable_scale(const std::string& unit, double largest);

/// "x displacement of P (mm)".
[[nodiscard]] std::string axis_label(const std::string& words, const std::string& unit);

}  // namespace trammel::reports
