#include "harness/base/quantity.h"

#include <set>
#include <utility>

namespace trammel::harness {
namespace {

/// Suffixes of quantity names, with their units. Long suffixes precede short ones, so that "_N_m"
/// is not read as "_m".
const std::vector<std::pair<std::string, std::string>>& units() {
  static const std::vector<std::pair<std::string, std::string>> table = {
      {"_Hz_m3_per_kg", "Hz m^3/kg"},
      {"_N_m_per_rad", "N m/rad"},
      {"_rad_per_s2", "rad/s^2"},
      {"_rad_per_s", "rad/s"},
      {"_m_per_s2", "m/s^2"},
      {"_N_per_m", "N/m"},
      {"_Hz_rad_per_N_m", "Hz rad/(N m)"},
      {"_Hz_per_kg_m2", "Hz/(kg m^2)"},
      {"_Hz_per_rad", "Hz/rad"},
      {"_Hz_per_kg", "Hz/kg"},
      {"_Hz_per_Pa", "Hz/Pa"},
      {"_Hz_per_m", "Hz/m"},
      {"_percent", "%"},
      {"_deg", "deg"},
      {"_m_per_s", "m/s"},
      {"_kg_m2", "kg m^2"},
      {"_kg_m3", "kg/m^3"},
      {"_rad_s", "rad/s"},
      {"_per_s", "1/s"},
      {"_m_s2", "m/s^2"},
      {"_N_m", "N m"},
      {"_rad", "rad"},
      {"_kg", "kg"},
      {"_Pa", "Pa"},
      {"_Hz", "Hz"},
      {"_m2", "m^2"},
      {"_m3", "m^3"},
      {"_m4", "m^4"},
      {"_m", "m"},
      {"_s", "s"},
      {"_N", "N"},
      {"_J", "J"},
      {"_W", "W"},
  };
  return table;
}

}  // namespace

NameAndUnit split_name(const std::string& name) {
  const std::string head = name.substr(0, name.find(':'));
  for (const auto& [suffix, unit] : units())
    if (head.size() > suffix.size() && head.ends_with(suffix))
      return {head.substr(0, head.size() - suffix.size()), unit};
  return {head, "1"};
}

std::string unit_of(const std::string& name) {
  return split_name(name).unit;
}

bool is_count_quantity(const std::string& name) {
  static const std::set<std::string> counts = {
      "mode_count_below", "rigid_body_modes",  "degrees_of_freedom", "steps",
      "rejected_steps",   "evaluations",       "newton_iterations",  "unstable_directions",
      "sigmas_tried",     "kernel_evaluations"};
  return counts.count(name) > 0;
}

bool is_error_measure(const std::string& name) {
  const std::string head = name.substr(0, name.find(':'));
  return head.find("roundoff") != std::string::npos || head.find("residual") != std::string::npos;
}

}  // namespace trammel::harness
