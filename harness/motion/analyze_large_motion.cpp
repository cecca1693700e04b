#include <cmath>

#include "harness/base/number.h"
#include "harness/base/recorder.h"
#include "harness/motion/analyses.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/drawing.h"
#include "harness/scene/observables.h"
#include "harness/scene/tracking.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/large/equilibrium.h"
#include "solver/large/integrate_large_motion.h"
#include "solver/large/state_results.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using solver::large_motion::GeometricallyExactSystem;
using solver::large_motion::State;

/// Rotation of a node relative to another node, or to the ground (from = -1).
struct Angle {
  std::string name;
  solver::Index node = 0, from = -1;
  double start = 0;
};

/// Nodes and angles that are recorded at each output time.
struct OutputSelection {
  std::vector<solver::Index> nodes;
  solver::Index seen_from = -1;
  std::vector<Angle> angles;
};

/// Returns the index of a named node. The node must have a rotation, because the analysis records
/// an angle of the node or motions relative to the axes of the node.
solver::Index node_with_rotation(const JsonView& name, const GeometricallyExactSystem& system) {
  const solver::Index node = find_node(name, system.model());
  if (system.layout().node[solver::to_size(node)][2] < 0)
    throw name.error("expected a node with a rotation (all members are hinged at this node)");
  return node;
}

OutputSelection read_selection(const JsonView& analysis, const GeometricallyExactSystem& system) {
  const solver::Model& model = system.model();
  OutputSelection selection;
  if (const auto names = analysis.find("nodes")) {
    for (const auto& entry : names->entries())
      selection.nodes.push_back(find_node(entry.second, model));
  } else {
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
      if (!model.nodes[i].name.empty()) selection.nodes.push_back(static_cast<solver::Index>(i));
  }
  if (analysis.has("relative_to"))
    selection.seen_from = node_with_rotation(analysis["relative_to"], system);
  if (const auto angles = analysis.find("angles"))
    for (const auto& [name, place] : angles->entries()) {
      Angle angle{name, node_with_rotation(place["node"], system), -1,
                  place.get("initial_rad", 0.0)};
      if (place.has("from")) angle.from = node_with_rotation(place["from"], system);
      selection.angles.push_back(angle);
    }
  return selection;
}

solver::TransientOptions read_large_motion_options(const JsonView& analysis) {
  solver::TransientOptions options;
  options.scheme = solver::generalized_alpha(analysis.get("spectral_radius", 0.9));
  if (analysis.get<std::string>("integrator", "generalized-alpha") == "energy-momentum") {
    options.scheme.conserves_energy = true;
    if (analysis.has("spectral_radius"))
      throw analysis["spectral_radius"].error(
          "this key requires the integrator 'generalized-alpha' (got 'energy-momentum')");
  }
  options.end = analysis.number("end_time_s");
  options.step = analysis.number("step_s");
  if (analysis.has("tolerance")) {
    options.adaptive = {.relative = analysis.number("tolerance")};
  } else {
    limit_time_step_count(analysis["step_s"], options.end);
  }
  const double output_step = analysis.get("output_step_s", options.adaptive ? 0 : options.step);
  if (analysis.has("output_step_s")) limit_time_step_count(analysis["output_step_s"], options.end);
  if (output_step > 0) options.sample_times = solver::even_times(0, options.end, output_step);
  options.max_steps = analysis.get("steps", options.max_steps);
  return options;
}

/// Returns the displacement of each node in axes that move and rotate with the node `eye`:
///   relative = R^T (arm + moved) - arm
/// R is the rotation of `eye`, `arm` the initial vector from `eye` to the node, and `moved` the
/// difference of their displacements. The row of `eye` is NaN.
Eigen::MatrixX3d observed_from(solver::Index eye, const solver::Model& model,
                               const Eigen::MatrixX3d& motion) {
  Eigen::MatrixX3d relative = motion.rowwise() - motion.row(eye);
  const double turn = motion(eye, 2), c = std::cos(turn), s = std::sin(turn);
  // Computes cos(turn) - 1 by the half angle, which avoids cancellation.
  const double less = -2 * std::sin(turn / 2) * std::sin(turn / 2);
  for (solver::Index node = 0; node < relative.rows(); ++node) {
    const Eigen::Vector2d arm =
        model.nodes[solver::to_size(node)].position - model.nodes[solver::to_size(eye)].position;
    const Eigen::Vector2d moved = relative.row(node).head<2>().transpose();
    relative(node, 0) = c * moved.x() + s * moved.y() + less * arm.x() + s * arm.y();
    relative(node, 1) = c * moved.y() - s * moved.x() + less * arm.y() - s * arm.x();
  }
  relative.row(eye).setConstant(kNaN);
  return relative;
}

/// Returns the reactions in the supported directions, and NaN in the other directions.
Eigen::MatrixX3d support_reactions(const GeometricallyExactSystem& system, const State& state) {
  Eigen::MatrixX3d reaction = reactions(system, state);
  for (std::size_t i = 0; i < system.model().supports.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (!system.model().supports[i].fixed[k])
        reaction(static_cast<solver::Index>(i), static_cast<solver::Index>(k)) = kNaN;
  return reaction;
}

/// Records the requested quantities at each state of the motion that the integrator reports.
class MotionRecorder {
 public:
  MotionRecorder(const GeometricallyExactSystem& system, OutputSelection selection,
                 Recorder& record)
      : system_(system),
        selection_(std::move(selection)),
        states_(system.model(), "large-motion", {}, &selection_.nodes),
        record_(record) {}

  void look(const State& state) {
    record_.add("time_s", state.t);
    ModelState now;
    now.displacement = node_motion(system_, state.q);
    now.velocity = node_motion(system_, state.v);
    now.reaction = support_reactions(system_, state);
    if (selection_.seen_from >= 0)
      now.relative = observed_from(selection_.seen_from, system_.model(), now.displacement);
    states_.record(now, record_);
    for (const Angle& angle : selection_.angles) {
      const auto component_of = [&](const Eigen::MatrixX3d& values) {
        return values(angle.node, 2) - (angle.from >= 0 ? values(angle.from, 2) : 0.0);
      };
      record_.add("angle_rad", angle.name, angle.start + component_of(now.displacement));
      record_.add("angle_rate_rad_per_s", angle.name, component_of(now.velocity));
    }
    record_actuator_drives(system_, state, record_);
    for (const solver::large_motion::Torque& torque : system_.large_motion().torques)
      record_.add("torque_N_m", torque.name, torque.law(state.t));
    const solver::large_motion::Energy energy = system_.energy(state);
    energy_.record(energy.kinetic, energy.strain, energy.total(), record_);
  }

  [[nodiscard]] double energy_drift() const { return energy_.relative_drift(); }

 private:
  const GeometricallyExactSystem& system_;
  OutputSelection selection_;
  StateRecorder states_;
  EnergyRecorder energy_;
  Recorder& record_;
};

void require_path_until_end_time(const JsonView& analysis, const solver::Path& path) {
  try {
    (void)solver::at(path, analysis.number("end_time_s"));
  } catch (const solver::ModelError& error) {
    throw analysis["end_time_s"].error(
        std::string("the trajectory does not last until this time: ") + error.what());
  }
}

/// Records the deflection of the platform point P from its position on the same manipulator with
/// rigid links.
void record_deflection(const GeometricallyExactSystem& system, const State& state,
                       const solver::Path& path, Recorder& record) {
  const solver::Index p = system.model().find_node("P");
  const Eigen::MatrixX3d motion = node_motion(system, state.q);
  const Eigen::Vector2d now =
      system.model().nodes[solver::to_size(p)].position + motion.row(p).head<2>().transpose();
  const solver::Pose pose = solver::at(path, state.t).pose;
  record.add("pose_x_m", pose.x);
  record.add("pose_y_m", pose.y);
  record.add("deflection_x_m", "P", now.x() - pose.x);
  record.add("deflection_y_m", "P", now.y() - pose.y);
  record.add("deflection_m", "P", std::hypot(now.x() - pose.x, now.y() - pose.y));
}

/// Integrates the motion from the model's initial state. If the manipulator tracks a path, the
/// initial velocities are those of the manipulator with rigid links.
solver::large_motion::IntegrationSummary integrate_motion(
    const GeometricallyExactSystem& system, const CaseModel& case_model, bool tracking,
    const solver::TransientOptions& options, bool extrapolated,
    const solver::large_motion::Observer& look) {
  if (tracking) return integrate_tracking(case_model, system, options, look);
  State state;
  return extrapolated ? integrate_extrapolated(system, state, options, look)
                      : integrate(system, state, options, look);
}

void record_summary(const solver::large_motion::IntegrationSummary& summary,
                    const MotionRecorder& log, Recorder& record) {
  record.add("steps", summary.accepted);
  record.add("rejected_steps", summary.rejected);
  record.add("newton_iterations", summary.iterations);
  record.add("smallest_step_s", summary.smallest_step);
  record.add("constraint_residual", summary.constraints.position);
  record.add("constraint_rate_residual", summary.constraints.rate);
  record.add("energy_drift", log.energy_drift());
}

}  // namespace

StepResult analyze_large_motion(const JsonView& analysis, const CaseModel& case_model, bool draw,
                                Recorder& record) {
  solver::Model model = build_without_joint_elements(case_model, 0);
  solver::large_motion::LargeMotionModel large_motion = case_model.joint_elements;
  read_prescribed_motions(analysis, model, large_motion);
  read_motion_conditions(analysis, model, large_motion);
  const bool damped = case_model.effects.has(solver::Effect::damping) &&
                      (large_motion.mass_damping > 0 || large_motion.strain_rate_damping > 0);
  if (!damped) large_motion.mass_damping = large_motion.strain_rate_damping = 0;
  const bool extrapolated = analysis.get("extrapolated", false), tracking = analysis.has("track");
  if (tracking) {
    add_tracking(analysis["track"],
                 analysis.text("track") == "torques" ? Tracking::torques : Tracking::angles,
                 case_model, model, large_motion);
    require_path_until_end_time(analysis, *case_model.path);
    for (const char* key : {"extrapolated", "initial_velocities"})
      if (analysis.has(key)) throw analysis[key].error("this key excludes 'track'");
    if (analysis.get<std::string>("integrator", "generalized-alpha") != "generalized-alpha")
      throw analysis["integrator"].error("'track' requires the integrator 'generalized-alpha'");
  }
  release_driven_actuators(analysis, case_model, large_motion, model);
  const GeometricallyExactSystem system(model, large_motion);
  solver::TransientOptions options = read_large_motion_options(analysis);
  options.breakpoints = system.large_motion().load_breakpoints;
  StepResult result;
  if (draw) result.drawing = draw_initial_pose(system, case_model.manipulator.has_value());
  MotionRecorder log(system, read_selection(analysis, system), record);
  const auto moments =
      static_cast<double>(result.drawing ? max_drawn_times(result.drawing->nodes.size()) - 1 : 1);
  State last;
  const auto look = [&](const State& state) {
    log.look(state);
    last = state;
    if (tracking) record_deflection(system, state, *case_model.path, record);
    if (!result.drawing) return;
    std::vector<results::Pose>& poses = result.drawing->poses;
    const double next = options.end * static_cast<double>(poses.size()) / moments;
    if (state.t < next * (1 - 1e-9)) return;
    poses.push_back(draw_pose(system, state.q, time_label(state.t)));
    poses.back().time_s = state.t;
  };
  const solver::large_motion::IntegrationSummary summary =
      integrate_motion(system, case_model, tracking, options, extrapolated, look);
  result.outcome = summary.outcome;
  result.evidence = summary.evidence;
  result.counters = summary.counters;
  solver::count_element_evaluations(system, summary.iterations, true, result.counters);
  if (damped) result.counters.add(solver::Effect::damping, summary.iterations);
  result.counters.element_evaluations = system.element_evaluations();
  record_summary(summary, log, record);
  if (result.outcome.solved() && last.q.size() > 0)
    warn_of_redundant_constraints(redundant_constraint_count(system, last), result.warnings);
  return result;
}

}  // namespace trammel::harness
