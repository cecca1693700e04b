#include "harness/analysis/analysis.h"

#include <Eigen/LU>
#include <cfenv>
#include <cmath>

#include "harness/analysis/coarse_scene.h"
#include "harness/analysis/registry.h"
#include "harness/analysis/size_estimate.h"
#include "harness/scene/rethrow_as_input.h"
#include "solver/manipulator/kinematics.h"

namespace trammel::harness {
namespace {

using solver::Residual;

int solver_rounding = FE_TONEAREST;

/// Sets the floating-point rounding mode to `solver_rounding` during the lifetime of the object.
class RoundingScope {
 public:
  RoundingScope() : before_(std::fegetround()) { std::fesetround(solver_rounding); }
  ~RoundingScope() { std::fesetround(before_); }
  RoundingScope(const RoundingScope&) = delete;
  RoundingScope& operator=(const RoundingScope&) = delete;

 private:
  int before_;
};

StepResult run_case_model_analysis(const AnalysisKind& kind, const JsonView& analysis,
                                   const CaseModel& case_model, bool draw, Recorder& record) {
  if (case_model.path && !kind.has_own_times)
    for (const solver::TrajectoryPoint& point : case_model.motion) {
      record.add("time_s", point.time);
      record.add("pose_x_m", point.pose.x);
      record.add("pose_y_m", point.pose.y);
      record.add("pose_phi_rad", point.pose.phi);
    }
  if (const auto* along_path = std::get_if<AnalysePath*>(&kind.of_scene))
    return (*along_path)(analysis, case_model, draw, record);
  const auto at_step = [&](std::size_t step, bool drawn) {
    return std::get<AnalyseStep*>(kind.of_scene)(analysis, case_model, step, drawn, record);
  };
  return analyze_path_points(case_model, draw, at_step);
}

/// Returns the result of an analysis. The status "solved" requires a solution, sufficiently small
/// residuals and finite numbers.
AnalysisResult make_result(const AnalysisKind& kind, StepResult found, Recorder& record) {
  AnalysisResult result{std::move(found), {}, {}};
  if (!kind.evidence.empty())
    result.outcome = solver::outcome_by_evidence(result.outcome, result.evidence, kind.evidence);
  if (result.outcome.solved() && !record.first_nonfinite_quantity().empty())
    result.outcome = {solver::Status::not_converged,
                      record.first_nonfinite_quantity() + " is not a finite number"};
  if (!result.outcome.solved()) return result;
  result.quantities = record.take_quantities();
  const double of_load =
      result.evidence.has(Residual::load) ? result.evidence.largest(Residual::load) : 0;
  if (of_load > solver::kLoadWarning)
    result.warnings.push_back(
        {"the ratio of the residual to the loads", of_load, "",
         "the model is ill-conditioned, so that round-off error dominates the forces"});
  return result;
}

/// Records, for each automatically selected physical effect, its dimensionless number and the
/// change of the results without it. Checks of a case can refer to these quantities.
void record_effect_evidence(const EffectChoice& choice, Recorder& record) {
  if (!choice.automatic) return;
  for (const solver::Effect effect : solver::Effects::all().list()) {
    const EffectEvidence& evidence = choice.automatic->evidence[static_cast<std::size_t>(effect)];
    const std::string name(solver::name_of(effect));
    if (evidence.number) record.add("effect_number", name, *evidence.number);
    const auto add_change = [&](const char* quantity, const std::optional<double>& change) {
      if (change && std::isfinite(*change)) record.add(quantity, name, *change);
    };
    add_change("effect_change", evidence.own);
    add_change("effect_cumulative_change", evidence.cumulative);
  }
}

}  // namespace

void warn_of_crossed_singularity(const CaseModel& case_model, std::vector<Warning>& warnings) {
  if (!case_model.manipulator || !case_model.path) return;
  const solver::ManipulatorGeometry& geometry = case_model.manipulator->geometry;
  double before = 0;
  for (const solver::TrajectoryPoint& point : case_model.motion) {
    const solver::Posture posture = solver::inverse_kinematics(geometry, point.pose);
    if (!posture.outcome.solved()) return;
    const double now = solver::jacobians(geometry, point.pose, posture).parallel.determinant();
    if (before * now < 0) {
      add_warning(
          warnings,
          {"the time of the first point after a parallel singularity", point.time, " s",
           "rigid links require infinite torques at a singular pose; hinged links soften near it"});
      return;
    }
    if (now != 0) before = now;
  }
}

void set_solver_rounding_mode(int mode) {
  solver_rounding = mode;
}

results::Counters named_counters(const solver::Counters& counters) {
  return {{"element_evaluations", counters.element_evaluations},
          {"factorizations", counters.factorizations},
          {"solves", counters.solves},
          {"steps", counters.steps}};
}

std::string analysis_kind(const Document& document) {
  return document.value().at("analysis").begin().key();
}

AnalysisResult analyze(const Document& document, const References& references,
                       const AnalysisOptions& options) {
  require_sufficient_memory(document);
  const AnalysisKind& kind = find_analysis(analysis_kind(document));
  Recorder record;
  if (!kind.needs_model(document)) {
    const RoundingScope scope;
    return make_result(kind, kind.of_case(document, references, options.drawing, record), record);
  }
  const JsonView place = JsonView(document)["analysis"][kind.name];
  CaseModel case_model = read_case_model(document);
  if (kind.needs_manipulator && !case_model.manipulator)
    throw place.error("expected a model with 'manipulator'");
  return rethrow_as_input_error(document, [&] {
    const RoundingScope scope;
    EffectChoice choice = choose_effects(document, case_model);
    case_model.effects = choice.chosen;
    record_effect_evidence(choice, record);
    AnalysisResult result = make_result(
        kind, run_case_model_analysis(kind, place, case_model, options.drawing, record), record);
    result.effects = std::move(choice.rows);
    if (result.outcome.solved() && kind.warns_of_crossing)
      warn_of_crossed_singularity(case_model, result.warnings);
    if (choice.is_beyond_linear_theory())
      result.warnings.push_back(
          {"the change by large displacement", *choice.automatic->beyond_tier, "",
           "above the tolerance; the effect requires fixed time steps and driven actuators"});
    return result;
  });
}

}  // namespace trammel::harness
