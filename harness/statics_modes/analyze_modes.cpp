#include <algorithm>
#include <cmath>
#include <complex>

#include "harness/readers/field_reader.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/observables.h"
#include "harness/statics_modes/analyses.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/linear/modes.h"
#include "solver/linear/reduction.h"
#include "solver/linear/rotating_frame.h"
#include "solver/manipulator/pose_modes.h"
#include "solver/model/numbers.h"

namespace trammel::harness {

TRAMMEL_WORDS(solver::RotationAxis, "normal", "x", "y");

namespace {

solver::ModesOptions read_modes_options(const JsonView& analysis) {
  return {analysis["count"].get<solver::Index>(), read_eigen_method(analysis)};
}

/// Rejects a key that is incompatible with modes about a loaded or rotating state.
void forbid_key(const JsonView& analysis, const char* key, const char* other_key,
                const char* reason) {
  if (!analysis.has(key) || analysis[key].json() == false) return;
  throw analysis[key].error(std::string("this key excludes '") + other_key + "': " + reason);
}

/// Returns the system of equations, reduced to fixed-interface modes if the analysis has the key
/// "reduction".
solver::System reduce_system_if_requested(const JsonView& analysis, const CaseModel& case_model,
                                          solver::System system) {
  if (!analysis.has("reduction")) return system;
  forbid_key(analysis, "count_below_Hz", "reduction",
             "'count_below_Hz' counts all modes of the full model");
  if (case_model.effects.has(solver::Effect::geometric_stiffening))
    throw analysis["reduction"].error("expected no geometric stiffening ('prestressed')");
  if (analysis["reduction"].has("modes"))
    throw analysis["reduction"].error(
        "this analysis requires a reduction by 'fixed_interface_modes' (got 'modes')");
  // The reduction omits the loads, because they do not affect modes without prestress.
  return solver::reduce_members(
      system, analysis["reduction"].get<solver::Index>("fixed_interface_modes", 0));
}

solver::ModalSolution compute_modes_of_case(const JsonView& analysis, const CaseModel& case_model,
                                            const solver::System& system) {
  const solver::ModesOptions options = read_modes_options(analysis);
  if (!case_model.effects.has(solver::Effect::geometric_stiffening))
    return solver::solve_modes(system, options);
  forbid_key(analysis, "count_below_Hz", analysis.has("prestressed") ? "prestressed" : "effects",
             "'count_below_Hz' counts modes of the unloaded model");
  return solver::solve_prestressed_modes(system, options);
}

/// @param path  true if there is a path; frequencies are then recorded as one quantity per mode
void record_modes(const Eigen::VectorXd& frequency, const Eigen::VectorXd& roundoff, bool path,
                  Recorder& record) {
  for (solver::Index i = 0; i < frequency.size(); ++i) {
    const std::string item = path ? std::to_string(i + 1) : "";
    record.add("frequency_Hz", item, frequency[i], roundoff[i]);
    record.add("frequency_roundoff", item, roundoff[i]);
    if (i == 0) continue;
    const double apart = frequency[i] - frequency[i - 1];
    record.add("frequency_gap", item, apart == 0 ? 0 : apart / frequency[i]);
  }
}

std::optional<Drawing> draw_modes(const CaseModel& case_model, const solver::System& system,
                                  const solver::ModalSolution& modes) {
  std::optional<Drawing> drawing = draw_model(system, case_model.manipulator.has_value());
  if (!drawing || !modes.outcome.solved()) return drawing;
  for (solver::Index i = 0; i < std::min(kMaxDrawnShapes, modes.frequency.size()); ++i)
    drawing->shapes.push_back(
        draw_shape(system, modes.shape.col(i), mode_label(i, modes.frequency[i], "Hz")));
  return drawing;
}

/// Returns the nodal translations of each mode shape as a column of norm 1.
Eigen::MatrixXd unit_mode_translations(const solver::System& system, const Eigen::MatrixXd& shape) {
  const Eigen::MatrixXd u = system.T * shape;
  const auto& nodes = system.coordinates.node;
  Eigen::MatrixXd translations(2 * std::ssize(nodes), u.cols());
  for (solver::Index i = 0; i < std::ssize(nodes); ++i)
    for (std::size_t c = 0; c < 2; ++c)
      translations.row(2 * i + static_cast<solver::Index>(c)) = u.row(nodes[solver::to_size(i)][c]);
  return translations.colwise().normalized();
}

/// Tracks the modes of the first point along the path by their shapes. A mode continues as the mode
/// of the next point that resembles it most, by the modal assurance criterion (R. J. Allemang, D.
/// L. Brown, IMAC 1982). The most similar pairs are matched first, and each mode is matched once.
class ShapeTracker {
 public:
  void record(const solver::System& system, const solver::ModalSolution& modes, Recorder& record) {
    const Eigen::MatrixXd shape = unit_mode_translations(system, modes.shape);
    if (last_.size() == 0) last_ = shape;
    Eigen::MatrixXd assurance = (last_.transpose() * shape).cwiseAbs2();
    Eigen::VectorXd frequency = Eigen::VectorXd::Constant(last_.cols(), std::nan(""));
    Eigen::VectorXd alike = frequency;
    for (solver::Index left = std::min(last_.cols(), shape.cols()); left > 0; --left) {
      solver::Index k = 0, mode = 0;
      const double most = assurance.maxCoeff(&k, &mode);
      alike[k] = most;
      frequency[k] = modes.frequency[mode];
      last_.col(k) = shape.col(mode);
      assurance.row(k).setConstant(-1);
      assurance.col(mode).setConstant(-1);
    }
    for (solver::Index k = 0; k < frequency.size(); ++k) {
      record.add_or_missing("tracked_frequency_Hz", std::to_string(k + 1), frequency[k]);
      record.add_or_missing("shape_assurance", std::to_string(k + 1), alike[k]);
    }
  }

 private:
  /// Current shapes: a row per nodal translation, a column per mode of the first point.
  Eigen::MatrixXd last_;
};

/// Returns the shape of a complex mode at the instant when its largest component is at its maximum.
Eigen::VectorXd shape_at_maximum(const Eigen::VectorXcd& shape) {
  solver::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> turn = std::conj(shape[largest]) / std::abs(shape[largest]);
  return (turn * shape).real();
}

/// Reads the options of modes in a rotating frame, except for the effects and the speed.
solver::RotatingOptions read_rotating_options(const JsonView& modes) {
  const JsonView rotating = modes["rotating"];
  solver::RotatingOptions options;
  options.count = modes["count"].get<solver::Index>();
  options.method = read_eigen_method(modes);
  options.frame.axis = rotating.get("axis", solver::RotationAxis::normal);
  if (rotating.has("center_m")) options.frame.center = read_point(rotating["center_m"]);
  options.prestress_at_steady_state =
      rotating.get<std::string>("prestress_configuration", "deformed") == "deformed";
  return options;
}

/// Computes modes in a steadily rotating frame (key "rotating") at one speed or at several speeds.
/// The outcome is that of the first speed without a steady state.
/// @param effects  physical effects of the case, which include or omit Coriolis forces and
///   stiffening by tension
StepResult analyze_rotating(const JsonView& modes, const solver::System& system,
                            solver::Effects effects, bool draw, Recorder& record) {
  const Json& stated = modes["rotating"]["angular_speed_rad_s"].json();
  const bool several = stated.is_array();
  const auto speeds =
      several ? stated.get<std::vector<double>>() : std::vector{stated.get<double>()};
  solver::RotatingOptions options = read_rotating_options(modes);
  options.gyroscopic = effects.has(solver::Effect::gyroscopic);
  options.stiffening = effects.has(solver::Effect::geometric_stiffening);
  StepResult result{{}, system.counters};
  if (draw) result.drawing = draw_model(system, false);
  const StateRecorder recorder(system.model, "modes");
  for (const double speed : speeds) {
    options.frame.speed = speed;
    const solver::RotatingModes found = solver::solve_rotating_modes(system, options);
    solver::Counters step_counters = found.counters;  // these counters include `system.counters`
    step_counters.element_evaluations = 0;
    for (std::size_t i = 0; i < solver::kEffectCount; ++i)
      step_counters.effects[i] -= system.counters.effects[i];
    result.counters += step_counters;
    result.outcome = found.outcome;
    result.evidence.add(found.evidence);
    if (!found.outcome.solved()) return result;
    record.add("angular_speed_rad_s", speed);
    record_frequencies(found.frequency, found.growth_rate, several, record);
    record.add("stable", found.stable ? 1 : 0);
    ModelState state;
    state.displacement = solver::node_motion(system, found.q);
    recorder.record(state, record);
    if (!result.drawing || several) continue;
    for (solver::Index i = 0; i < std::min(found.frequency.size(), kMaxDrawnShapes); ++i)
      result.drawing->shapes.push_back(draw_shape(system, shape_at_maximum(found.shape.col(i)),
                                                  mode_label(i, found.frequency[i], "Hz")));
  }
  record.add("degrees_of_freedom", system.K.rows());
  return result;
}

StepResult analyze_modes_at(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, ShapeTracker* tracker, Recorder& record) {
  if (analysis.has("rotating")) {
    forbid_key(analysis, "count_below_Hz", "rotating", "it counts modes of the model at rest");
    forbid_key(analysis, "reduction", "rotating", "the reduced model has no Coriolis forces");
    forbid_key(analysis, "prestressed", "rotating", "'rotating' includes this stiffening");
    if (case_model.path) throw analysis["rotating"].error("'rotating' requires one 'pose'");
    return analyze_rotating(analysis, solver::assemble(build_model(case_model, step)),
                            case_model.effects, draw, record);
  }
  const solver::System system = reduce_system_if_requested(
      analysis, case_model, solver::assemble(build_model(case_model, step), case_model.effects));
  const solver::ModalSolution modes = compute_modes_of_case(analysis, case_model, system);
  StepResult result{modes.outcome, modes.counters, modes.evidence};
  if (draw) result.drawing = draw_modes(case_model, system, modes);
  if (!modes.outcome.solved()) return result;
  if (modes.frequency.size() == 0) {
    result.outcome = {solver::Status::singular, system.K.rows() == 0
                                                    ? "no vibration: every motion is restrained"
                                                    : "no vibration: no movable part has a mass"};
    return result;
  }
  record_modes(modes.frequency, modes.roundoff, case_model.path.has_value(), record);
  if (const auto count = read_modes_options(analysis).count; modes.frequency.size() < count)
    add_warning(result.warnings,
                {"'count'", static_cast<double>(count), "", "the model has fewer modes"});
  warn_of_taper(system.model, result.warnings);
  warn_of_wave_length(system, modes.frequency.maxCoeff(), result.warnings);
  if (analysis.has("count_below_Hz")) {
    const auto below = solver::sturm_count(system, analysis.number("count_below_Hz"));
    record.add_or_missing("mode_count_below", "",
                          below ? static_cast<double>(*below) : std::nan(""));
  }
  if (tracker != nullptr) tracker->record(system, modes, record);
  record.add("rigid_body_modes", modes.zero_energy_mode_count);
  record.add("degrees_of_freedom", system.K.rows());
  return result;
}

/// Returns true if condensing each link to its ends saves more time than it costs. The dense
/// matrices of the remaining coordinates must also be small.
bool saves_time_by_condensation(const solver::ManipulatorDesign& design) {
  constexpr solver::Index kMostElements = 100;
  for (std::size_t i = 0; i < 3; ++i)
    if (std::max(design.proximal[i].elements, design.distal[i].elements) > kMostElements)
      return false;
  return design.platform.kind == solver::PlatformKind::rigid ||
         (design.platform.refinements == 0 && design.platform.pin_radius == 0 &&
          !design.platform.six_nodes);
}

/// Returns true if the modes of all poses are computed together. The case must have a manipulator
/// on a path, and no other parts, rotating frame, reduction or geometric stiffening.
bool solves_all_poses_together(const JsonView& analysis, const CaseModel& case_model) {
  const solver::Model& others = case_model.structure;
  const auto& joints = case_model.joint_elements;
  return case_model.path && case_model.manipulator &&
         saves_time_by_condensation(*case_model.manipulator) && !analysis.has("rotating") &&
         !analysis.has("reduction") && !analysis.has("count_below_Hz") &&
         !case_model.effects.has(solver::Effect::geometric_stiffening) && others.nodes.empty() &&
         others.members.empty() && others.triangles.empty() && others.rigid_bodies.empty() &&
         others.masses.empty() && others.springs.empty() && others.supports.empty() &&
         others.constraints.empty() && joints.sliders.empty() && joints.line_springs.empty() &&
         joints.follower_loads.empty() &&
         read_modes_options(analysis).method == solver::EigenMethod::automatic;
}

StepResult analyze_modes_of_poses(const JsonView& analysis, const CaseModel& case_model, bool draw,
                                  Recorder& record) {
  std::vector<solver::Pose> poses;
  for (const solver::TrajectoryPoint& point : case_model.motion) poses.push_back(point.pose);
  const solver::ModesOptions options = read_modes_options(analysis);
  const solver::PoseModes modes = solver::solve_pose_modes(
      *case_model.manipulator, poses, {.count = options.count, .active = case_model.effects});
  StepResult result;
  result.counters = modes.counters;
  if (draw) {
    const solver::System first = solver::assemble(build_model(case_model, 0), case_model.effects);
    result.drawing = draw_modes(case_model, first, solver::solve_modes(first, options));
  }
  for (std::size_t step = 0; step < poses.size(); ++step) {
    result.evidence.add(modes.evidence[step]);
    if (!modes.outcome[step].solved()) {
      result.outcome = outcome_at_path_point(case_model, step, modes.outcome[step]);
      break;
    }
    const auto column = static_cast<solver::Index>(step);
    const auto found = modes.frequency.rows() - modes.frequency.col(column).array().isNaN().count();
    record_modes(modes.frequency.col(column).head(found), modes.roundoff.col(column).head(found),
                 true, record);
    record.add("rigid_body_modes", modes.zero_energy_mode_count[step]);
    record.add("degrees_of_freedom", modes.free_coordinates);
    record.add("uncondensed_poses", modes.by_itself);
  }
  return result;
}

}  // namespace

StepResult analyze_modes(const JsonView& analysis, const CaseModel& case_model, bool draw,
                         Recorder& record) {
  const bool tracks = analysis.get("track_shapes", false);
  if (tracks) {
    forbid_key(analysis, "rotating", "track_shapes", "a rotating frame requires one 'pose'");
    if (!case_model.path) throw analysis["track_shapes"].error("this key requires 'trajectory'");
  } else if (solves_all_poses_together(analysis, case_model)) {
    return analyze_modes_of_poses(analysis, case_model, draw, record);
  }
  ShapeTracker tracker;
  return analyze_path_points(case_model, draw, [&](std::size_t step, bool drawn) {
    return analyze_modes_at(analysis, case_model, step, drawn, tracks ? &tracker : nullptr, record);
  });
}

}  // namespace trammel::harness
