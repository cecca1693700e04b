#include "harness/analysis/registry.h"

#include <algorithm>
#include <stdexcept>

#include "harness/analysis/analyze_study.h"
#include "harness/base/text.h"
#include "harness/motion/analyses.h"
#include "harness/statics_modes/analyses.h"

namespace trammel::harness {
namespace {

using solver::Residual;

const std::vector<Residual> kModes = {Residual::eigenvalue_equation, Residual::mode_count};

}  // namespace

bool AnalysisKind::needs_model(const Document& document) const {
  return of_case == nullptr || (of_scene.index() != 0 && document.value().contains("model"));
}

const std::vector<AnalysisKind>& analysis_kinds() {
  static const std::vector<AnalysisKind> kinds = {
      {.name = "properties", .of_scene = analyze_properties},
      {.name = "kinematics",
       .of_scene = analyze_kinematics,
       .needs_manipulator = true,
       .evidence = {Residual::constraints},
       .warns_of_crossing = true},
      {.name = "statics",
       .of_scene = analyze_statics,
       .effects = &kStaticsEffects,
       .evidence = {Residual::equilibrium},
       .warns_of_crossing = true},
      {.name = "buckling",
       .of_scene = analyze_buckling,
       .evidence = {Residual::equilibrium, Residual::mode_count}},
      {.name = "modes", .of_scene = analyze_modes, .effects = &kModesEffects, .evidence = kModes},
      {.name = "large-statics",
       .of_scene = analyze_large_statics,
       .evidence = {Residual::equilibrium, Residual::recovered_forces}},
      {.name = "large-motion",
       .of_scene = analyze_large_motion,
       .effects = &kLargeMotionEffects,
       .evidence = {Residual::equation_of_motion, Residual::constraints},
       .has_own_times = true},
      {.name = "harmonic",
       .of_scene = analyze_harmonic,
       .effects = &kHarmonicEffects,
       .evidence = {Residual::equilibrium}},
      {.name = "transient",
       .of_scene = analyze_transient,
       .effects = &kTransientEffects,
       .evidence = {Residual::equation_of_motion}},
      {.name = "inverse-dynamics",
       .of_scene = analyze_inverse_dynamics,
       .needs_manipulator = true,
       .evidence = {Residual::energy},
       .warns_of_crossing = true},
      {.name = "forward-dynamics",
       .of_scene = analyze_forward_dynamics,
       .needs_manipulator = true,
       .evidence = {Residual::equation_of_motion, Residual::constraints, Residual::energy}},
      {.name = "elastodynamics",
       .of_scene = analyze_elastodynamics,
       .needs_manipulator = true,
       .effects = &kElastodynamicsEffects,
       .evidence = {Residual::equation_of_motion},
       .warns_of_crossing = true},
      {.name = "sensitivity",
       .of_scene = analyze_sensitivity,
       .needs_manipulator = true,
       .evidence = kModes},
      {.name = "sensitivity-map",
       .of_scene = analyze_sensitivity_map,
       .needs_manipulator = true,
       .evidence = kModes},
      {.name = "grnn",
       .of_scene = analyze_grnn,
       .needs_manipulator = true,
       .of_case = analyze_grnn_samples,
       .without_model = "none: the case contains samples",
       .warns_of_crossing = true},
      {.name = "manufactured",
       .of_case = analyze_manufactured,
       .without_model = "created by the analysis: mesh and loads of a closed-form solution",
       .evidence = {Residual::equilibrium}},
      {.name = "comparison",
       .of_case = analyze_comparison,
       .without_model = "none: comparison of references"},
      {.name = "model-probabilities",
       .of_case = analyze_model_probabilities,
       .without_model = "none: stored probabilities of interpretations"},
      {.name = "study", .of_case = analyze_study, .without_model = "created by the analysis"},
      {.name = "options", .of_case = analyze_options, .without_model = "models of other cases"}};
  return kinds;
}

const AnalysisKind& find_analysis(const std::string& name) {
  const auto& kinds = analysis_kinds();
  const auto found = std::ranges::find(kinds, name, &AnalysisKind::name);
  if (found == kinds.end()) throw std::out_of_range("no analysis '" + name + "'");
  return *found;
}

std::string analyses_with_effects() {
  std::vector<std::string> names;
  for (const AnalysisKind& kind : analysis_kinds())
    if (kind.effects != nullptr) names.emplace_back(kind.name);
  return join(names, "or");
}

}  // namespace trammel::harness
