#include <algorithm>

#include "harness/base/text.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/drawing.h"
#include "harness/scene/observables.h"
#include "harness/scene/tracking.h"
#include "harness/statics_modes/analyses.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/large/equilibrium.h"
#include "solver/large/small_vibration.h"
#include "solver/large/state_results.h"
#include "solver/large/static_path.h"

namespace trammel::harness {
namespace {

using solver::large_motion::GeometricallyExactSystem;
using solver::large_motion::PathEvent;
using solver::large_motion::PathPoint;
using solver::large_motion::StaticPath;

constexpr std::size_t kMaxPoses = 6;

solver::large_motion::StaticPathOptions read_large_statics_options(const JsonView& analysis) {
  solver::large_motion::StaticPathOptions options;
  options.first_step = analysis.get("first_step", options.first_step);
  options.max_points = analysis.get("points", options.max_points);
  options.switch_branch = analysis.get("switch_branch", false);
  options.keep_points = analysis.get("whole_path", false);
  return options;
}

void record_path_point(const GeometricallyExactSystem& system, const PathPoint& point,
                       Recorder& record, std::vector<Warning>& warnings) {
  record.add("load_factor", point.state.load);
  const ModelState solution{static_solution(system, point.state)};
  StateRecorder(system.model(), "large-statics").record(solution, record);
  warn_of_strain(system.model(), solution, warnings);
  record_actuator_drives(system, point.state, record);
  record.add("newton_iterations", point.newton.correction.size());
  if (point.unstable_directions >= 0) record.add("unstable_directions", point.unstable_directions);
}

/// Records natural frequencies about an equilibrium. If there are several equilibria, each mode has
/// a separate quantity.
void record_vibration(const GeometricallyExactSystem& system, const PathPoint& point,
                      solver::Index count, bool several, StepResult& result, Recorder& record) {
  const auto found = solver::large_motion::small_vibration(system, point.state, count);
  result.outcome = found.outcome;
  result.evidence.add(found.evidence);
  if (!found.outcome.solved()) return;
  record_frequencies(found.frequency, found.growth_rate, several, record, found.roundoff);
  warn_of_roundoff(found.roundoff.size() > 0 ? found.roundoff.maxCoeff() : 0, result.warnings);
}

void record_events(const std::vector<PathEvent>& events, Recorder& record) {
  for (const PathEvent& event : events) {
    const bool limit = event.kind == PathEvent::Kind::limit_point;
    record.add(limit ? "limit_load_factor" : "bifurcation_load_factor", event.load);
  }
}

void record_newton_iterations(const solver::large_motion::NewtonResult& newton, Recorder& record) {
  for (std::size_t i = 0; i < newton.correction.size(); ++i) {
    record.add("newton_iteration", i + 1);
    record.add("newton_correction", newton.correction[i]);
    if (i < newton.force_residual.size())
      record.add("newton_residual_N_m", newton.force_residual[i]);
  }
}

void draw_poses(const GeometricallyExactSystem& system, const std::vector<PathPoint>& points,
                Drawing& drawing) {
  const std::size_t stride = (points.size() + kMaxPoses - 1) / kMaxPoses;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(stride, 1)) {
    const std::size_t last_first = points.size() - 1 - i;
    const solver::large_motion::State& state = points[last_first].state;
    drawing.poses.push_back(draw_pose(system, state.q, "load factor " + rounded(state.load, 3)));
  }
  std::ranges::reverse(drawing.poses);
}

}  // namespace

StepResult analyze_large_statics(const JsonView& analysis, const CaseModel& case_model,
                                 std::size_t step, bool draw, Recorder& record) {
  const auto factors = analysis.get("load_factors", std::vector<double>{1.0});
  if (case_model.path && factors.size() > 1)
    throw analysis["load_factors"].error("a model with 'trajectory' requires a single load factor");
  solver::large_motion::StaticPathOptions options = read_large_statics_options(analysis);
  if (options.keep_points && (case_model.path || factors.size() > 1))
    throw analysis["whole_path"].error("'whole_path' requires one pose and one load factor");
  // With vibration modes, an unsupported part is a mode of 0 Hz. In statics alone, such a part has
  // no determined position, and the model is singular.
  options.keep_free_parts = analysis.get("vibration_modes", solver::Index{0}) > 0;
  solver::Model model = build_without_joint_elements(case_model, step);
  solver::large_motion::LargeMotionModel large_motion = case_model.joint_elements;
  read_prescribed_motions(analysis, model, large_motion);
  release_driven_actuators(analysis, case_model, large_motion, model);
  const GeometricallyExactSystem system(model, large_motion);
  StepResult result;
  if (draw) result.drawing = draw_initial_pose(system, case_model.manipulator.has_value());
  std::vector<PathPoint> recorded_points;
  std::vector<PathEvent> events;  // critical points up to the largest load factor
  const double longest = *std::ranges::max_element(factors);
  for (const double factor : factors) {
    options.target = factor;
    StaticPath path = follow_static_path(system, options);
    result.counters.element_evaluations = system.element_evaluations();
    result.counters.factorizations += path.counters.factorizations;
    result.counters.solves += path.counters.solves;
    result.counters.steps += path.counters.steps;
    result.outcome = path.outcome;
    result.evidence.add(path.evidence);
    if (!path.outcome.solved()) return result;
    recorded_points.insert(recorded_points.end(), path.points.begin(), path.points.end());
    if (factor == longest) events = std::move(path.events);
  }
  warn_of_redundant_constraints(redundant_constraint_count(system, recorded_points.back().state),
                                result.warnings);
  const auto vibrations = analysis.get("vibration_modes", solver::Index{0});
  if (!large_motion.follower_loads.empty() && vibrations == 0)
    result.warnings.push_back(
        {"the number of follower loads, which turn with their nodes",
         static_cast<double>(large_motion.follower_loads.size()), "",
         "statics does not detect flutter instability; 'vibration_modes' detects it"});
  for (const PathPoint& point : recorded_points) {
    record_path_point(system, point, record, result.warnings);
    if (vibrations > 0)
      record_vibration(system, point, vibrations, case_model.path || recorded_points.size() > 1,
                       result, record);
    if (!result.outcome.solved()) return result;
  }
  if (!case_model.path) {
    record_events(events, record);
    record_newton_iterations(recorded_points.back().newton, record);
  }
  if (result.drawing) draw_poses(system, recorded_points, *result.drawing);
  return result;
}

}  // namespace trammel::harness
