#pragma once

#include <array>
#include <optional>

#include "harness/analysis/effect_changes.h"
#include "harness/analysis/registry.h"

/// Closed-form dimensionless numbers by which negligible effects are found without a computation.
namespace trammel::harness {

/// Wave number and phase of the response of an analysis. They determine the dimensionless numbers
/// of effects and the estimated changes of the results.
struct ResponseScale {
  double half_waves = 1;  ///< number of bending half waves per member
  /// Ratio of the relative change of the results to that of a stiffness or mass. In a transient
  /// vibration, this ratio is half of the phase angle [rad].
  double phase = 1;
  double platform = 1;         ///< ratio as `phase`, for a change of the platform's stiffness
  bool loads_stiffen = false;  ///< true if the axial forces of loads change the stiffness
};

struct EffectNumber {
  std::optional<double> value;  ///< dimensionless number, see `dimensionless_number_formula`
  /// Estimated relative change of the results if the effect is removed; infinite if no upper bound
  /// of the change is known.
  double change;
};

using EffectNumbers = std::array<EffectNumber, solver::kEffectCount>;

[[nodiscard]] ResponseScale response_scale(const std::string& analysis_name,
                                           const JsonView& analysis, const solver::Model& model);

/// Computes the dimensionless numbers of axial flexibility, shear, rotary inertia, joint
/// compliance, platform flexibility and geometric stiffening. The wave number of n half waves in a
/// member is k = n pi / L, and the numbers are
///   axial:            E I k^2 / (E A)
///   shear:            E I k^2 / (kappa G A)
///   rotary inertia:   (k r)^2
///   joint compliance: E I k / c
///   platform:         (E I / L^3) / (E t)
///   stiffening:       P D^2 / (pi^2 E I)
/// E, G, A, I, kappa and r are moduli, area, second moment of area, shear coefficient and radius of
/// gyration of a section. L is the length of a member [m], and c the stiffness of a joint's spring
/// [N m/rad]. t is the thickness of the platform [m], P the sum of all loads [N], and D the
/// diameter of the frame [m]. Each number is the largest over the members.
///   Source: Timoshenko, Philosophical Magazine 41 (1921), for shear and rotary inertia. The others
/// are ratios of stiffnesses in series or in parallel.
[[nodiscard]] EffectNumbers dimensionless_numbers(const solver::Model& model,
                                                  const ResponseScale& scale);

}  // namespace trammel::harness
