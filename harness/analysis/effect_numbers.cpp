#include "harness/analysis/effect_numbers.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trammel::harness {
namespace {

using solver::Effect;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Returns the highest of the first natural angular frequencies of all members, each clamped at one
/// end [rad/s].
double max_first_natural_frequency(const solver::Model& model) {
  double highest = 0;
  for (const solver::Member& member : model.members) {
    const solver::Section& section = member.section;
    const double length = member_length(model, member);
    if (section.EI > 0 && section.mass_per_length > 0)
      highest = std::max(
          highest, 3.516 * std::sqrt(section.EI / section.mass_per_length) / (length * length));
  }
  return highest;
}

/// Returns the largest number of bending half waves in a member at an angular frequency [rad/s].
double max_half_waves_in_member(const solver::Model& model, double omega) {
  double most = 1;
  for (const solver::Member& member : model.members) {
    const solver::Section& section = member.section;
    if (!(section.EI > 0)) continue;
    const double k = std::pow(section.mass_per_length * omega * omega / section.EI, 0.25);
    most = std::max(most, k * member_length(model, member) / std::numbers::pi);
  }
  return most;
}

}  // namespace

ResponseScale response_scale(const std::string& analysis_name, const JsonView& analysis,
                             const solver::Model& model) {
  ResponseScale scale;
  const auto members = std::max<solver::Index>(std::ssize(model.members), 1);
  scale.loads_stiffen =
      analysis_name == "statics" || analysis_name == "modes" || analysis_name == "large-motion";
  if (analysis_name == "modes") {
    scale.phase = scale.platform = 0.5;  // a frequency is proportional to sqrt(stiffness)
    scale.half_waves +=
        static_cast<double>((analysis.get<solver::Index>("count", 1) - 1) / members);
  } else if (analysis_name == "harmonic") {
    // Near a resonance, the relative change of the response is much larger than that of the
    // stiffness or mass that causes it. Only damping limits this amplification. The sampled
    // frequencies rarely contain the resonance peak. The assumed amplification is between kLeast
    // and kMost. These limits cover the random models of the tests.
    constexpr double kLeast = 30, kMost = 300;
    const double omega = 2 * std::numbers::pi * analysis.number("to_Hz");
    const auto damping = analysis.find("damping");
    const auto rayleigh = damping ? damping->find("rayleigh") : std::nullopt;
    const double stiffness = rayleigh ? rayleigh->get("stiffness_s", 0.0) : 0;
    scale.half_waves = max_half_waves_in_member(model, omega);
    scale.phase = stiffness > 0 ? std::clamp(1 / (stiffness * omega), kLeast, kMost) : kMost;
    scale.platform = 10;
  } else if (analysis_name == "transient" || analysis_name == "large-motion") {
    const char* const end = analysis_name == "transient" ? "duration_s" : "end_time_s";
    scale.phase = scale.platform =
        std::max(1.0, max_first_natural_frequency(model) * analysis.number(end) / 2);
  }
  return scale;
}

EffectNumbers dimensionless_numbers(const solver::Model& model, const ResponseScale& scale) {
  /// Assumed ratios of the change of the results to the dimensionless numbers of platform
  /// flexibility and joint compliance. In nearly all random models of the tests, the true ratios
  /// are smaller.
  constexpr double kOfPlatform = 17, kOfJoint = 3;
  /// Ratio of the relative change of a frequency to the dimensionless number of geometric
  /// stiffening. A cantilever buckles at a quarter of pi^2 E I / L^2, and a frequency changes by
  /// half as much as the stiffness.
  constexpr double kOfStiffening = 2;
  double shear = 0, rotary = 0, axial = 0, joint = 0, bending = 0, membrane = kInfinite;
  double softest = kInfinite;
  for (const solver::Member& member : model.members) {
    const solver::Section& section = member.section;
    if (!(section.EI > 0)) continue;
    const double length = member_length(model, member);
    const double k = scale.half_waves * std::numbers::pi / length;
    if (section.EA > 0) axial = std::max(axial, section.EI / section.EA * k * k);
    if (solver::has_shear_deformation(member.theory))
      shear = std::max(shear, section.EI * k * k / section.kappa_GA);
    if (solver::has_rotary_inertia(member.theory) && section.mass_per_length > 0)
      rotary = std::max(rotary, section.inertia_per_length / section.mass_per_length * k * k);
    for (const solver::MemberEnd& end : member.ends)
      if (end.fixity == solver::EndFixity::sprung)
        joint = std::max(joint, section.EI * k / end.stiffness);
    bending = std::max(bending, section.EI / std::pow(length, 3));
    softest = std::min(softest, section.EI);
  }
  for (const solver::Plate& plate : model.plates)
    membrane = std::min(membrane, plate.material.E * plate.thickness);
  const ModelScales size = typical_model_scales(model);
  EffectNumbers numbers;
  numbers.fill({std::nullopt, kInfinite});
  const auto set = [&](Effect effect, double value, double of_change) {
    numbers[static_cast<std::size_t>(effect)] = {value, of_change};
  };
  const double load =
      size.force * size.length * size.length / (std::numbers::pi * std::numbers::pi * softest);
  // Loads near the buckling load of a cantilever amplify the change of the results by every effect.
  const double of_buckling = scale.loads_stiffen ? 4 * load : 0;
  const double factor = of_buckling < 0.95 ? scale.phase / (1 - of_buckling) : kInfinite;
  set(Effect::axial_flexibility, axial, kInfinite);  // infinite, because axial forces alone may
                                                     // carry the loads of a frame
  set(Effect::shear, shear, shear * factor);
  set(Effect::rotary_inertia, rotary, rotary * factor);
  set(Effect::joint_compliance, joint, kOfJoint * joint * factor);
  if (membrane < kInfinite)
    set(Effect::platform_flexibility, bending / membrane,
        kOfPlatform * bending / membrane * scale.platform);
  if (softest < kInfinite)
    set(Effect::geometric_stiffening, load, kOfStiffening * load * scale.phase);
  return numbers;
}

}  // namespace trammel::harness
