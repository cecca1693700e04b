#include "harness/analysis/analysis.h"

#include "harness/analysis/registry.h"
#include "harness/scene/with_model_errors.h"

namespace trammel::harness {
namespace {

/// Step by step along the path; ends where a step has no solution.
StepResult analyse_steps(StepAnalysis analyse_step, const JsonView& analysis,
                         const CaseModel& case_model, bool draw, Recorder& record) {
  StepResult all;
  for (std::size_t step = 0; step < case_model.steps(); ++step) {
    record_path(case_model, step, record);
    StepResult found = analyse_step(analysis, case_model, step, draw && step == 0, record);
    all.counters += found.counters;
    if (found.drawing) all.drawing = std::move(found.drawing);
    if (found.outcome.solved()) continue;
    all.outcome = outcome_at_path_point(case_model, step, found.outcome);
    break;
  }
  return all;
}

StepResult analyse_scene(const AnalysisKind& kind, const JsonView& analysis,
                         const CaseModel& case_model, bool draw, Recorder& record) {
  if (const auto* along_path = std::get_if<PathAnalysis>(&kind.of_scene))
    return (*along_path)(analysis, case_model, draw, record);
  return analyse_steps(std::get<StepAnalysis>(kind.of_scene), analysis, case_model, draw, record);
}

/// What was recorded counts where a solution was found.
AnalysisResult result_of(StepResult found, Recorder& record) {
  AnalysisResult result;
  result.outcome = std::move(found.outcome);
  result.drawing = std::move(found.drawing);
  result.counters = found.counters;
  result.timings = std::move(found.timings);
  if (result.outcome.solved()) result.quantities = record.take_quantities();
  return result;
}

}  // namespace

std::string analysis_kind(const Document& document) {
  return document.value().at("analysis").begin().key();
}

AnalysisResult analyse(const Document& document, const References& references,
                       const AnalysisOptions& options) {
  const AnalysisKind& kind = find_analysis(analysis_kind(document));
  Recorder record;
  if (!kind.needs_model(document)) {
    return result_of(kind.of_case(document, references, options.drawing, record), record);
  }
  const JsonView place = JsonView(document)["analysis"][kind.name];
  CaseModel case_model = read_case_model(document);
  if (kind.needs_manipulator && !case_model.manipulator) {
    throw place.error("expected a model with a manipulator");
  }
  return with_model_errors(document, [&] {
    EffectChoice choice = choose_effects(document, case_model);
    case_model.effects = choice.chosen;
    AnalysisResult result =
        result_of(analyse_scene(kind, place, case_model, options.drawing, record), record);
    result.analysis = kind.name;
    result.effects = std::move(choice.reasons);
    return result;
  });
}

}  // namespace trammel::harness
