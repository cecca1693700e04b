#include "harness/analysis.h"

#include "harness/analysis_kinds.h"
#include "harness/cursor.h"

namespace trammel {
namespace {

void add(Counters& total, const Counters& more) {
  total.element_evaluations += more.element_evaluations;
  total.factorizations += more.factorizations;
  total.solves += more.solves;
}

StepResult analyse_step(const std::string& kind, const Cursor& analysis, const Scene& scene,
                        std::size_t step, bool draw, Recorder& record) {
  if (kind == "modes") return analyse_modes(analysis, scene, step, draw, record);
  if (kind == "statics") return analyse_statics(analysis, scene, step, draw, record);
  if (kind == "buckling") return analyse_buckling(analysis, scene, step, draw, record);
  if (kind == "kinematics") return analyse_kinematics(scene, step, draw, record);
  return analyse_properties(scene, step, draw, record);
}

void record_path(const Scene& scene, std::size_t step, Recorder& record) {
  record.add("time_s", "", scene.time[step]);
  record.add("pose_x_m", "", scene.poses[step].x);
  record.add("pose_y_m", "", scene.poses[step].y);
  record.add("pose_phi_rad", "", scene.poses[step].phi);
}

}  // namespace

std::string analysis_kind(const Document& document) {
  return document.value().at("analysis").begin().key();
}

AnalysisResult analyse(const Document& document, const References& references,
                       const AnalysisOptions& options) {
  const std::string kind = analysis_kind(document);
  const Cursor place = Cursor(document)["analysis"][kind];
  AnalysisResult result;
  Recorder record;
  if (kind == "comparison") {
    compare_references(place, references, record);
    result.quantities = record.take();
    return result;
  }
  if (kind == "manufactured") {
    StepResult found = analyse_manufactured(place, options.drawing, record);
    return {found.outcome, record.take(), std::move(found.drawing), found.counters};
  }
  const Scene scene = read_scene(document);
  if (kind == "kinematics" && !scene.manipulator) {
    throw place.error("expected a model with a manipulator");
  }
  try {
    for (std::size_t step = 0; step < scene.steps(); ++step) {
      const bool draw = options.drawing && step == 0;
      if (scene.along_path) record_path(scene, step, record);
      StepResult found = analyse_step(kind, place, scene, step, draw, record);
      add(result.counters, found.counters);
      if (found.drawing) result.drawing = std::move(found.drawing);
      if (found.outcome.solved()) continue;
      result.outcome = found.outcome;
      if (scene.along_path) {
        result.outcome.reason = "point " + std::to_string(step) + ": " + result.outcome.reason;
      }
      return result;
    }
  } catch (const ModelError& error) {
    throw model_error(document, error);
  }
  result.quantities = record.take();
  return result;
}

}  // namespace trammel
