#include "harness/statics_modes/analyse_modes.h"

#include <cmath>

#include "harness/readers/eigen_method.h"
#include "harness/statics_modes/rotating_state.h"
#include "solver/modes/modes.h"
#include "solver/modes/prestressed_modes.h"
#include "solver/modes/reduction.h"

namespace trammel::harness {
namespace {

solver::ModesOptions read_modes_options(const JsonView& analysis) {
  return {analysis["count"].get<solver::Index>(), read_eigen_method(analysis)};
}

/// What cannot stand beside the modes of a state that loads or rotation make.
void refuse(const JsonView& analysis, const char* key, const char* beside, const char* reason) {
  if (!analysis.has(key) || analysis[key].json() == false) return;
  throw analysis[key].error(std::string("expected it without '") + beside + "': " + reason);
}

/// The system in the coordinates that the analysis asks for.
solver::System condensed(const JsonView& analysis, const CaseModel& case_model,
                         solver::System system) {
  if (!analysis.has("reduction")) return system;
  refuse(analysis, "count_below_Hz", "reduction", "it counts the modes of the whole model");
  if (case_model.effects.has(solver::Effect::geometric_stiffening)) {
    throw analysis["reduction"].error("expected it without geometric stiffening ('prestressed')");
  }
  return solver::reduce_members(
      system, analysis["reduction"]["fixed_interface_modes"].get<solver::Index>());
}

solver::ModalSolution modes_of(const JsonView& analysis, const CaseModel& case_model,
                               const solver::System& system) {
  const solver::ModesOptions options = read_modes_options(analysis);
  if (!case_model.effects.has(solver::Effect::geometric_stiffening))
    return solver::solve_modes(system, options);
  refuse(analysis, "count_below_Hz", analysis.has("prestressed") ? "prestressed" : "effects",
         "it counts the modes of the unloaded model");
  return solver::solve_prestressed_modes(system, options).modes;
}

}  // namespace

StepResult analyse_modes(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                         bool draw, Recorder& record) {
  if (analysis.has("rotating")) {
    refuse(analysis, "count_below_Hz", "rotating", "it counts the modes of the model at rest");
    refuse(analysis, "reduction", "rotating", "it has no Coriolis forces");
    refuse(analysis, "prestressed", "rotating", "a rotating frame always holds its loads");
    if (case_model.path) throw analysis["rotating"].error("expected a model at one place");
    return analyse_rotating(analysis, solver::assemble(build_model(case_model, step)),
                            case_model.effects, draw, record);
  }
  const solver::System system = condensed(
      analysis, case_model, solver::assemble(build_model(case_model, step), case_model.effects));
  const solver::ModalSolution modes = modes_of(analysis, case_model, system);
  StepResult result{modes.outcome, modes.counters, std::nullopt, {}, modes.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!modes.outcome.solved()) return result;
  for (solver::Index i = 0; i < modes.frequency.size(); ++i) {
    const std::string item = case_model.path ? std::to_string(i + 1) : "";
    record.add("frequency_Hz", item, modes.frequency[i], modes.roundoff[i]);
    record.add("frequency_roundoff", item, modes.roundoff[i]);
    if (i > 0) {
      const double apart = modes.frequency[i] - modes.frequency[i - 1];
      record.add("frequency_gap", item, apart == 0 ? 0 : apart / modes.frequency[i]);
    }
    if (result.drawing && i < kMaxDrawnShapes) {
      result.drawing->shapes.push_back(
          draw_shape(system, modes.shape.col(i), mode_label(i, modes.frequency[i], "Hz")));
    }
  }
  if (analysis.has("count_below_Hz")) {
    const std::optional<solver::Index> below =
        solver::sturm_count(system, analysis.number("count_below_Hz"));
    record.add_or_gap("mode_count_below", "", below ? static_cast<double>(*below) : std::nan(""));
  }
  record.add("rigid_body_modes", "", static_cast<double>(modes.zero_energy_mode_count));
  record.add("degrees_of_freedom", "", static_cast<double>(system.K.rows()));
  return result;
}

}  // namespace trammel::harness
