#include "harness/analysis/effect_changes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trammel::harness {
namespace {

/// Of each kind, what its changes are measured by: not round-off.
std::map<std::string, double> scales_of(const Quantities& full, double size) {
  constexpr double kNothing = 1e-9;
  std::map<std::string, double> scale;
  for (const auto& [name, quantity] : full) {
    const std::string kind = change_kind(name);
    if (!kind.empty()) scale[kind] = std::max(scale[kind], max_abs(quantity.values));
  }
  const auto floor = [&](const char* kind, const char* beside, double arm) {
    if (scale.count(kind) + scale.count(beside) < 2) return;
    scale[kind] = std::max(scale[kind], kNothing * scale[beside] * arm);
  };
  floor("displacement", "rotation", size);
  floor("rotation", "displacement", 1 / size);
  floor("force", "moment", 1 / size);
  floor("moment", "force", size);
  return scale;
}

}  // namespace

std::string change_kind(const std::string& quantity) {
  static const std::vector<std::pair<std::string, std::string>> kinds = {
      {"displacement_", "displacement"},
      {"rotation_rad", "rotation"},
      {"end_rotation_rad", "rotation"},
      {"reaction_moment_", "moment"},
      {"reaction_", "force"},
      {"axial_force_", "force"},
      {"shear_force_", "force"},
      {"bending_moment_", "moment"},
      {"stress_Pa", "stress"},
      {"bending_stress_Pa", "stress"},
      {"position_", "position"},
      {"velocity_", "velocity"},
      {"angular_velocity_", "angular velocity"},
      {"acceleration_", "acceleration"},
      {"angle_rad", "rotation"},
      {"drive_force_N", "force"},
      {"drive_torque_N_m", "moment"},
      {"frequency_Hz", "frequency"}};
  for (const auto& [start, kind] : kinds) {
    if (quantity.rfind(start, 0) == 0) return kind;
  }
  return "";
}

Changes changes_between(const Quantities& full, const Quantities& other, double size_m) {
  const auto scale = scales_of(full, size_m);
  Changes changes;
  for (const auto& [kind, by] : scale) changes[kind] = {};
  for (const auto& [name, quantity] : full) {
    const std::string kind = change_kind(name);
    if (kind.empty()) continue;
    const auto found = other.find(name);
    LargestDifference& largest = changes[kind];
    if (found == other.end()) {  // a part may have no such thing without the effect; a mode is lost
      if (kind == "frequency") largest.value = std::numeric_limits<double>::infinity();
      continue;
    }
    const auto by = [&, &quantity = quantity, scale = scale.at(kind)](std::size_t i) {
      return kind == "frequency" ? std::abs(quantity.values[i]) : scale;
    };
    const LargestDifference change = largest_difference(quantity.values, found->second.values, by);
    if (change.value > largest.value) largest = change;
  }
  return changes;
}

LargestDifference max_change(const Changes& changes) {
  LargestDifference largest;
  for (const auto& [kind, change] : changes) {
    if (change.value > largest.value) largest = change;
  }
  return largest;
}

}  // namespace trammel::harness
