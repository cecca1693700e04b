#include "harness/statics_modes/analyse_modes.h"

#include <algorithm>
#include <cmath>

#include "harness/readers/option_reader.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/statics_modes/rotating_state.h"
#include "solver/linear/modes.h"
#include "solver/linear/reduction.h"
#include "solver/manipulator/pose_modes.h"
#include "solver/model/numbers.h"

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
  if (analysis["reduction"].has("modes"))
    throw analysis["reduction"].error("expected 'fixed_interface_modes': modes are looked for");
  // Loads do not act in modes.
  return solver::reduce_members(
      system, analysis["reduction"].get<solver::Index>("fixed_interface_modes", 0));
}

solver::ModalSolution modes_of(const JsonView& analysis, const CaseModel& case_model,
                               const solver::System& system) {
  const solver::ModesOptions options = read_modes_options(analysis);
  if (!case_model.effects.has(solver::Effect::geometric_stiffening))
    return solver::solve_modes(system, options);
  refuse(analysis, "count_below_Hz", analysis.has("prestressed") ? "prestressed" : "effects",
         "it counts the modes of the unloaded model");
  return solver::solve_prestressed_modes(system, options);
}

/// @param item  the mode, along a path
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
  for (solver::Index i = 0; i < std::min(kMaxDrawnShapes, modes.frequency.size()); ++i) {
    drawing->shapes.push_back(
        draw_shape(system, modes.shape.col(i), mode_label(i, modes.frequency[i], "Hz")));
  }
  return drawing;
}

/// Translations of all nodes of the mesh, each column of length 1.
Eigen::MatrixXd unit_translations(const solver::System& system, const Eigen::MatrixXd& shape) {
  const Eigen::MatrixXd u = system.T * shape;
  const auto& nodes = system.coordinates.node;
  Eigen::MatrixXd translations(2 * std::ssize(nodes), u.cols());
  for (solver::Index i = 0; i < std::ssize(nodes); ++i) {
    for (std::size_t c = 0; c < 2; ++c) {
      translations.row(2 * i + static_cast<solver::Index>(c)) = u.row(nodes[solver::to_size(i)][c]);
    }
  }
  return translations.colwise().normalized();
}

/// Follows the modes of the first point by their shapes: from point to point each goes on as the
/// one that resembles it most, by the modal assurance criterion (R. J. Allemang, D. L. Brown, IMAC
/// 1982); the most alike are taken first, each mode once.
class ShapeTracker {
 public:
  void record(const solver::System& system, const solver::ModalSolution& modes, Recorder& record) {
    const Eigen::MatrixXd shape = unit_translations(system, modes.shape);
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
      record.add_or_gap("tracked_frequency_Hz", std::to_string(k + 1), frequency[k]);
      record.add_or_gap("shape_assurance", std::to_string(k + 1), alike[k]);
    }
  }

 private:
  Eigen::MatrixXd last_;  ///< translation x mode of the first point, as it now looks
};

StepResult analyse_modes_at(const JsonView& analysis, const CaseModel& case_model, std::size_t step,
                            bool draw, Recorder& record, ShapeTracker* tracker = nullptr) {
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
  if (draw) result.drawing = draw_modes(case_model, system, modes);
  if (!modes.outcome.solved()) return result;
  if (modes.frequency.size() == 0) {
    result.outcome = {solver::Status::singular,
                      system.K.rows() == 0 ? "nothing vibrates, for everything is held"
                                           : "nothing vibrates, for nothing that moves has mass"};
    return result;
  }
  record_modes(modes.frequency, modes.roundoff, case_model.path.has_value(), record);
  warn_of_taper(system.model, result.warnings);
  warn_of_wave_length(system, modes.frequency.maxCoeff(), result.warnings);
  if (analysis.has("count_below_Hz")) {
    const std::optional<solver::Index> below =
        solver::sturm_count(system, analysis.number("count_below_Hz"));
    record.add_or_gap("mode_count_below", "", below ? static_cast<double>(*below) : std::nan(""));
  }
  if (tracker != nullptr) tracker->record(system, modes, record);
  record.add("rigid_body_modes", "", static_cast<double>(modes.zero_energy_mode_count));
  record.add("degrees_of_freedom", "", static_cast<double>(system.K.rows()));
  return result;
}

StepResult analyse_modes_alone(const JsonView& analysis, const CaseModel& case_model,
                               std::size_t step, bool draw, Recorder& record) {
  return analyse_modes_at(analysis, case_model, step, draw, record);
}

/// Point by point, as `analyse_steps`.
StepResult track_modes(const JsonView& analysis, const CaseModel& case_model, bool draw,
                       Recorder& record) {
  refuse(analysis, "rotating", "track_shapes", "it has a model at one place");
  if (!case_model.path) throw analysis["track_shapes"].error("expected a trajectory");
  ShapeTracker tracker;
  StepResult all;
  for (std::size_t step = 0; step < case_model.steps() && all.outcome.solved(); ++step) {
    record_path(case_model, step, record);
    StepResult found =
        analyse_modes_at(analysis, case_model, step, draw && step == 0, record, &tracker);
    all.counters += found.counters;
    all.evidence.add(found.evidence);
    if (found.drawing) all.drawing = std::move(found.drawing);
    if (!found.outcome.solved())
      all.outcome = outcome_at_path_point(case_model, step, found.outcome);
  }
  return all;
}

/// Whether the links are condensed in less time than they save, and the joints' matrices, which are
/// dense, are small.
bool is_condensable(const solver::ManipulatorDesign& design) {
  constexpr solver::Index kMostElements = 100;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::max(design.proximal[i].elements, design.distal[i].elements) > kMostElements)
      return false;
  }
  return design.platform.kind == solver::PlatformKind::rigid ||
         (design.platform.refinements == 0 && design.platform.pin_radius == 0 &&
          !design.platform.six_nodes);
}

/// Whether the modes follow the pose: a manipulator on a path, alone, at rest and without loads
/// that stiffen it.
bool follows_pose(const JsonView& analysis, const CaseModel& case_model) {
  const solver::Model& others = case_model.structure;
  const auto& joints = case_model.joint_elements;
  return case_model.path && case_model.manipulator && is_condensable(*case_model.manipulator) &&
         !analysis.has("rotating") && !analysis.has("reduction") &&
         !analysis.has("count_below_Hz") &&
         !case_model.effects.has(solver::Effect::geometric_stiffening) && others.nodes.empty() &&
         others.members.empty() && others.triangles.empty() && others.rigid_bodies.empty() &&
         others.masses.empty() && others.springs.empty() && others.supports.empty() &&
         others.constraints.empty() && joints.sliders.empty() && joints.line_springs.empty() &&
         joints.follower_loads.empty() &&
         read_modes_options(analysis).method == solver::EigenMethod::automatic;
}

StepResult analyse_modes_of_poses(const JsonView& analysis, const CaseModel& case_model, bool draw,
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
    record_path(case_model, step, record);
    result.evidence.add(modes.evidence[step]);
    if (!modes.outcome[step].solved()) {
      result.outcome = outcome_at_path_point(case_model, step, modes.outcome[step]);
      break;
    }
    const auto column = static_cast<solver::Index>(step);
    const auto found = modes.frequency.rows() - modes.frequency.col(column).array().isNaN().count();
    record_modes(modes.frequency.col(column).head(found), modes.roundoff.col(column).head(found),
                 true, record);
    record.add("rigid_body_modes", "", static_cast<double>(modes.zero_energy_mode_count[step]));
    record.add("degrees_of_freedom", "", static_cast<double>(modes.free_coordinates));
    record.add("uncondensed_poses", "", static_cast<double>(modes.by_itself));
  }
  return result;
}

}  // namespace

StepResult analyse_modes(const JsonView& analysis, const CaseModel& case_model, bool draw,
                         Recorder& record) {
  if (analysis.get("track_shapes", false)) return track_modes(analysis, case_model, draw, record);
  return follows_pose(analysis, case_model)
             ? analyse_modes_of_poses(analysis, case_model, draw, record)
             : analyse_steps(analyse_modes_alone, analysis, case_model, draw, record);
}

}  // namespace trammel::harness
