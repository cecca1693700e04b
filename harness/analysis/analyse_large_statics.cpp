#include <algorithm>

#include "harness/analysis/analysis_kinds.h"
#include "harness/scene/draw_large.h"
#include "harness/scene/joint_reader.h"
#include "harness/base/text.h"
#include "solver/large_motion/solve/state_results.h"
#include "solver/large_motion/solve/static_path.h"
#include "solver/large_motion/solve/large_statics.h"

namespace trammel {
namespace {

using large::LargeSystem;
using large::PathEvent;
using large::PathPoint;
using large::StaticPath;

constexpr std::size_t most_poses = 6;

large::StaticPathOptions read_options(const Cursor& analysis) {
  large::StaticPathOptions options;
  options.first_step = analysis.get("first_step", options.first_step);
  options.points = analysis.get("points", options.points);
  options.switch_branch = analysis.get("switch_branch", false);
  options.keep_points = analysis.get("whole_path", false);
  return options;
}

void record_point(const LargeSystem& system, const PathPoint& point, Recorder& record) {
  record.add("load_factor", "", point.state.load);
  record_solution(system.model(), static_solution(system, point.state), -1, record);
  for (std::size_t i = 0; i < system.scenario().drives.size(); ++i) {
    const large::Drive& drive = system.scenario().drives[i];
    record.add(drive.direction == 2 ? "drive_torque_N_m" : "drive_force_N", drive.name,
               drive_force(system, point.state, static_cast<Index>(i)));
  }
  record.add("newton_iterations", "", static_cast<double>(point.newton.correction.size()));
  if (point.unstable >= 0) {
    record.add("unstable_directions", "", static_cast<double>(point.unstable));
  }
}

void record_events(const StaticPath& path, Recorder& record) {
  for (const PathEvent& event : path.events) {
    const bool limit = event.kind == PathEvent::Kind::limit_point;
    record.add(limit ? "limit_load_factor" : "bifurcation_load_factor", "", event.load);
  }
}

/// How the last solution was found, iteration by iteration.
void record_newton(const large::NewtonResult& newton, Recorder& record) {
  for (std::size_t i = 0; i < newton.correction.size(); ++i) {
    record.add("newton_iteration", "", static_cast<double>(i + 1));
    record.add("newton_correction", "", newton.correction[i]);
    if (i < newton.residual.size()) record.add("newton_residual_N_m", "", newton.residual[i]);
  }
}

void draw_poses(const LargeSystem& system, const std::vector<PathPoint>& points, Drawing& drawing) {
  const std::size_t stride = (points.size() + most_poses - 1) / most_poses;
  for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(stride, 1)) {
    const std::size_t last_first = points.size() - 1 - i;
    const large::State& state = points[last_first].state;
    drawing.poses.push_back(
        draw_large_pose(system, state.q, "load factor " + rounded(state.load, 3)));
  }
  std::reverse(drawing.poses.begin(), drawing.poses.end());
}

}  // namespace

StepResult analyse_large_statics(const Cursor& analysis, const Scene& scene, std::size_t step,
                                 bool draw, Recorder& record) {
  const auto factors = analysis.get("load_factors", std::vector<double>{1.0});
  if (scene.path && factors.size() > 1) {
    throw analysis["load_factors"].error("expected one load factor along a trajectory");
  }
  large::StaticPathOptions options = read_options(analysis);
  if (options.keep_points && (scene.path || factors.size() > 1)) {
    throw analysis["whole_path"].error("expected one pose and one load factor beside it");
  }
  const Model model = build_bare_model(scene, step);
  large::Scenario scenario = scene.mechanism;
  read_drives(analysis, model, scenario);
  const LargeSystem system(model, scenario, {analysis.get("degree", 3)});
  StepResult result;
  if (draw) result.drawing = draw_large_model(system, scene.manipulator.has_value());
  std::vector<PathPoint> kept;
  StaticPath path;
  for (const double factor : factors) {
    options.target = factor;
    path = follow_static_path(system, options);
    result.counters.element_evaluations = system.element_evaluations();
    result.counters.factorizations += path.counters.factorizations;
    result.counters.solves += path.counters.solves;
    result.counters.steps += path.counters.steps;
    result.outcome = path.outcome;
    if (!path.outcome.solved()) return result;
    kept.insert(kept.end(), path.points.begin(), path.points.end());
  }
  for (const PathPoint& point : kept) record_point(system, point, record);
  if (!scene.path) {
    record_events(path, record);
    record_newton(kept.back().newton, record);
  }
  if (result.drawing) draw_poses(system, kept, *result.drawing);
  return result;
}

}  // namespace trammel
