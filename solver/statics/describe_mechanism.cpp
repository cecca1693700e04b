#include "solver/statics/describe_mechanism.h"

#include <cmath>
#include <cstdio>

#include "solver/model/plane.h"
#include "solver/statics/free_motions.h"

namespace trammel::solver {
namespace {

constexpr std::size_t kMaxParts = 3;  // of one mode
constexpr std::size_t kMaxModes = 6;

/// @param size  what lies a million times below it is 0
std::string pair_of(const Vector2d& value, double size) {
  char text[64];
  const auto rounded = [size](double x) { return std::abs(x) < 1e-6 * size ? 0 : x; };
  std::snprintf(text, sizeof text, "(%.4g, %.4g)", rounded(value.x()), rounded(value.y()));
  return text;
}

std::string axis_of(const Vector2d& direction) {
  if (std::abs(direction.y()) < 1e-6) return "x";
  if (std::abs(direction.x()) < 1e-6) return "y";
  return pair_of(direction, 1);
}

/// All that is said of a motion.
std::string message(const FreeMotion& motion, double model_size) {
  using Kind = FreeMotion::Kind;
  const std::string& part = motion.part;
  switch (motion.kind) {
    case Kind::in_plane:
      return part + " moves freely in the plane (along x, along y and in rotation)";
    case Kind::in_translation:
      return part + " moves freely along x and along y";
    case Kind::along:
      return part + " moves freely along " + axis_of(motion.vector);
    case Kind::about:
      return "rotation of " + part + " about " + pair_of(motion.vector, model_size) + " m";
    case Kind::turning:
      return part + " turns freely";
  }
  return part;
}

std::string listed(const std::vector<std::string>& messages, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < messages.size() && i < most; ++i)
    text += (i ? "; " : "") + messages[i];
  if (messages.size() > most) text += "; and " + std::to_string(messages.size() - most) + " more";
  return text;
}

}  // namespace

std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes) {
  const double size = box_diagonal(system.mesh.positions);
  std::vector<std::string> of_modes;
  for (const std::vector<FreeMotion>& motions : find_free_motions(system, modes.basis)) {
    std::vector<std::string> of_parts;
    for (const FreeMotion& motion : motions) of_parts.push_back(message(motion, size));
    of_modes.push_back(listed(of_parts, kMaxParts));
  }
  std::string text = listed(of_modes, kMaxModes);
  if (!modes.all_found) text += "; and others";
  return text;
}

}  // namespace trammel::solver
