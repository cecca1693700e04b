#pragma once

#include <array>
#include <optional>

#include "harness/analysis/effect_changes.h"
#include "harness/analysis/registry.h"

/// Dimensionless numbers in closed form, by which effects are left out without a computation.
namespace trammel::harness {

/// Wave number and duration of the responses that an analysis resolves.
struct ResponseScale {
  double half_waves = 1;  ///< per member
  /// Angle of the vibration over which a relative change of a frequency adds up [rad].
  double phase = 1;
  double platform = 1;         ///< the same of a change by the platform
  bool loads_stiffen = false;  ///< whether the axial forces of loads change the stiffness
};

struct EffectNumber {
  std::optional<double> value;  ///< `EffectRules::describe_number` defines it
  /// Estimated relative change of the results without the effect; infinite if the number does not
  /// limit it.
  double change;
};

using EffectNumbers = std::array<EffectNumber, solver::kEffectCount>;

[[nodiscard]] ResponseScale response_scale(const std::string& analysis_name,
                                           const JsonView& analysis, const solver::Model& model);

/// Numbers of shear, rotary inertia, joint compliance, platform flexibility and, in modes of a
/// frame at rest, geometric stiffening. With the wave number k = n pi / L of n half waves in a
/// member:
///   shear E I k^2 / (kappa G A), rotary inertia (k r)^2, joints E I k / c,
///   platform (E I / L^3) / (E t), stiffening P D^2 / (pi^2 E I),
/// where c is the stiffness of a joint's spring, t the thickness of the platform, P the sum of all
/// loads and D the diameter of the frame. Each is the largest over the members.
///   Source: Timoshenko, Philosophical Magazine 41 (1921), for shear and rotary inertia; the others
///   are ratios of stiffnesses in series or in parallel.
[[nodiscard]] EffectNumbers effect_numbers(const solver::Model& model, const ResponseScale& scale);

}  // namespace trammel::harness
