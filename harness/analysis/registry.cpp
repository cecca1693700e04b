#include "harness/analysis/registry.h"

#include <algorithm>
#include <stdexcept>

#include "harness/analysis/analyse_comparison.h"
#include "harness/analysis/analyse_model_probabilities.h"
#include "harness/analysis/analyse_options.h"
#include "harness/analysis/analyse_study.h"
#include "harness/base/text.h"
#include "harness/motion/analyse_elastodynamics.h"
#include "harness/motion/analyse_forward_dynamics.h"
#include "harness/motion/analyse_grnn.h"
#include "harness/motion/analyse_harmonic.h"
#include "harness/motion/analyse_inverse_dynamics.h"
#include "harness/motion/analyse_kinematics.h"
#include "harness/motion/analyse_large_motion.h"
#include "harness/motion/analyse_transient.h"
#include "harness/statics_modes/analyse_buckling.h"
#include "harness/statics_modes/analyse_large_statics.h"
#include "harness/statics_modes/analyse_manufactured.h"
#include "harness/statics_modes/analyse_modes.h"
#include "harness/statics_modes/analyse_properties.h"
#include "harness/statics_modes/analyse_sensitivity.h"
#include "harness/statics_modes/analyse_sensitivity_map.h"
#include "harness/statics_modes/analyse_statics.h"

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
      {"properties", analyse_properties},
      {"kinematics", analyse_kinematics, true, nullptr, nullptr, "", {Residual::constraints}},
      {"statics",
       analyse_statics,
       false,
       &statics_effects(),
       nullptr,
       "",
       {Residual::equilibrium},
       {},
       true},
      {"buckling",
       analyse_buckling,
       false,
       nullptr,
       nullptr,
       "",
       {Residual::equilibrium, Residual::mode_count}},
      {"modes", analyse_modes, false, &modes_effects(), nullptr, "", kModes},
      {"large-statics",
       analyse_large_statics,
       false,
       nullptr,
       nullptr,
       "",
       {Residual::equilibrium, Residual::recovered_forces}},
      {"large-motion",
       analyse_large_motion,
       false,
       &large_motion_effects(),
       nullptr,
       "",
       {Residual::equation_of_motion, Residual::constraints}},
      {"harmonic",
       analyse_harmonic,
       false,
       &harmonic_effects(),
       nullptr,
       "",
       {Residual::equilibrium},
       {harmonic_sample, analyse_harmonic_at}},
      {"transient",
       analyse_transient,
       false,
       &transient_effects(),
       nullptr,
       "",
       {Residual::equation_of_motion}},
      {"inverse-dynamics",
       analyse_inverse_dynamics,
       true,
       nullptr,
       nullptr,
       "",
       {Residual::energy},
       {},
       true},
      {"forward-dynamics",
       analyse_forward_dynamics,
       true,
       nullptr,
       nullptr,
       "",
       {Residual::equation_of_motion, Residual::constraints, Residual::energy}},
      {"elastodynamics",
       analyse_elastodynamics,
       true,
       &elastodynamics_effects(),
       nullptr,
       "",
       {Residual::equation_of_motion},
       {},
       true},
      {"sensitivity", analyse_sensitivity, true, nullptr, nullptr, "", kModes},
      {"sensitivity-map", analyse_sensitivity_map, true, nullptr, nullptr, "", kModes},
      {"grnn", analyse_grnn, true, nullptr, analyse_grnn_samples, "none: samples of its own"},
      {"manufactured",
       {},
       false,
       nullptr,
       analyse_manufactured,
       "made by the analysis: a mesh, and the loads of a closed form",
       {Residual::equilibrium}},
      {"comparison",
       {},
       false,
       nullptr,
       analyse_comparison,
       "no model: references against each other"},
      {"model-probabilities",
       {},
       false,
       nullptr,
       analyse_model_probabilities,
       "one for each reading of the case's manipulator"},
      {"study", {}, false, nullptr, analyse_study, "made by the analysis"},
      {"options", {}, false, nullptr, analyse_options, "those of other cases"}};
  return kinds;
}

const AnalysisKind& find_analysis(const std::string& name) {
  const auto& kinds = analysis_kinds();
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const AnalysisKind& kind) { return kind.name == name; });
  if (found == kinds.end()) throw std::out_of_range("no analysis '" + name + "'");
  return *found;
}

std::string analyses_with_effects() {
  std::vector<std::string> names;
  for (const AnalysisKind& kind : analysis_kinds()) {
    if (kind.effects != nullptr) names.emplace_back(kind.name);
  }
  return join(names, "or");
}

}  // namespace trammel::harness
