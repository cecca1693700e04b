#include <algorithm>
#include <cmath>
#include <numbers>

#include "harness/motion/analyses.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/case_model.h"
#include "harness/scene/observables.h"
#include "harness/statics_modes/range_warnings.h"
#include "solver/large/large_elastodynamics.h"
#include "solver/linear/modes.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/manipulator.h"

namespace trammel::harness {
namespace {

/// Records the deflection of the platform point P from the nominal path. If the nominal path has a
/// tangent at every sample, also records the components along and across the path.
void record_deflection(const solver::ElastodynamicsSolution& solution, Recorder& record) {
  const bool moves = solution.tangential_error.allFinite();
  for (solver::Index i = 0; i < solution.deflection.rows(); ++i) {
    record.add("deflection_m", "P", solution.deflection.row(i).norm());
    record.add("platform_rotation_rad", solution.platform_rotation[i]);
    if (!moves) continue;
    record.add("tangential_error_m", "P", solution.tangential_error[i]);
    record.add("normal_error_m", "P", solution.normal_error[i]);
  }
}

void record_torques(const solver::ElastodynamicsSolution& solution, Recorder& record) {
  for (solver::Index i = 0; i < solution.torque.rows(); ++i) {
    const Eigen::RowVector3d torque = solution.torque.row(i), rigid = solution.rigid_torque.row(i);
    record.add_each("torque_N_m", kActiveJoints, torque);
    record.add_each("rigid_torque_N_m", kActiveJoints, rigid);
    record.add_each("elastic_torque_N_m", kActiveJoints, Eigen::RowVector3d(torque - rigid));
  }
}

/// Records the energies and the drift of their sum, relative to the largest energy. The drift is
/// not recorded for quasi-static motion, or if the work of loads and actuators is not computed.
/// Modal superposition does not compute this work under varying loads. Time integration does not
/// compute this work for moving inextensible links without gyroscopic terms.
void record_energy(const solver::ElastodynamicsSolution& solution, bool quasi_static,
                   Recorder& record) {
  quasi_static |= !solution.energy.empty() && std::isnan(solution.energy.front().work);
  double size = 0;
  for (const solver::MotionEnergy& energy : solution.energy) {
    record.add("kinetic_energy_J", energy.kinetic);
    record.add("strain_energy_J", energy.strain);
    if (quasi_static) continue;
    record.add("load_work_J", energy.work);
    record.add("dissipated_energy_J", energy.dissipated);
    size = std::max({size, energy.kinetic, energy.strain, std::abs(energy.work)});
  }
  if (quasi_static || !(size > 0)) return;
  for (const solver::MotionEnergy& energy : solution.energy)
    record.add("energy_drift", (energy.total() - solution.energy.front().total()) / size);
}

/// Records the distance between the positions of the platform point P in the solutions `a` and `b`
/// at each sample, relative to the largest deflection of P in `a`.
void record_distance(const char* name, const Eigen::MatrixX2d& a, const Eigen::MatrixX2d& b,
                     Recorder& record) {
  const double size = a.rowwise().norm().maxCoeff();
  if (a.rows() != b.rows() || !(size > 0)) return;
  for (solver::Index i = 0; i < a.rows(); ++i)
    record.add(name, "P", (a.row(i) - b.row(i)).norm() / size);
}

solver::ElastodynamicsSolution solve(const solver::ElastodynamicsOptions& options,
                                     bool large_displacement) {
  return large_displacement ? solver::solve_large_elastodynamics(options)
                            : solver::solve_elastodynamics(options);
}

/// Records the change of the platform's deflection if the time step is halved. If the platform is
/// at rest, also records the error of the time integration, compared with exact modal
/// superposition.
void record_step_errors(solver::ElastodynamicsOptions options, bool large_displacement,
                        const solver::ElastodynamicsSolution& solution, Recorder& record) {
  if (!options.elastic_inertia || options.modal_superposition) return;
  if (solver::is_at_rest(options.path) && !options.gyroscopic && !large_displacement) {
    options.modal_superposition = true;
    record_distance("integration_error", solver::solve_elastodynamics(options).deflection,
                    solution.deflection, record);
    options.modal_superposition = false;
  }
  options.time.step /= 2;
  record_distance("step_change", solve(options, large_displacement).deflection, solution.deflection,
                  record);
}

/// Records the frequency above which Rayleigh damping is supercritical, and the number of modes
/// below it.
void record_damping(const solver::RayleighDamping& damping, const solver::System& start,
                    Recorder& record) {
  const double above = solver::overdamping_frequency(damping) / (2 * std::numbers::pi);
  if (!std::isfinite(above)) return;
  record.add("overdamped_above_Hz", above);
  const std::optional<solver::Index> below = solver::sturm_count(start, above);
  record.add_or_missing("mode_count_below", "", below ? static_cast<double>(*below) : std::nan(""));
}

/// Records dimensionless numbers that predict the importance of physical effects, and the numbers
/// and lengths of time steps.
void record_motion_summary(const solver::ElastodynamicsSolution& solution, Recorder& record) {
  const solver::ElastodynamicsEffects& effects = solution.effects;
  const solver::TransientSummary& summary = solution.summary;
  if (summary.accepted > 0) {  // the solution was computed by time integration
    record.add("steps", summary.accepted);
    record.add("rejected_steps", summary.rejected);
    record.add("smallest_step_s", summary.smallest_step);
    record.add("largest_step_s", summary.largest_step);
  }
  if (std::isnan(effects.first_frequency)) return;  // not computed for quasi-static or large motion
  if (summary.accepted > 0) record.add("step_residual", summary.largest_residual);
  record.add("first_frequency_Hz", effects.first_frequency);
  record.add("damping_ratio", effects.damping_ratio);
  if (std::isfinite(effects.nominal_inertia))
    record.add("nominal_inertia_number", effects.nominal_inertia);
  record.add("elastic_inertia_number", effects.elastic_inertia);
  record.add("transformation_rate_number", effects.gyroscopic);
}

/// Draws the motion at selected times: the nominal pose and the deflections of links and platform.
void draw_motion(const CaseModel& case_model, const solver::ElastodynamicsSolution& solution,
                 Drawing& drawing) {
  std::vector<Eigen::VectorXd> q;
  for (const solver::StaticSolution& state : solution.state) q.push_back(state.q);
  for (const std::size_t i : samples_to_draw(q, drawing.nodes.size())) {
    const solver::System system = solver::assemble(build_model(case_model, i));
    const std::string label = time_label(solution.time[i]);
    drawing.poses.push_back({label, draw_model(system, true)->nodes, solution.time[i],
                             draw_shape(system, q[i], label).displacement});
  }
}

}  // namespace

solver::ElastodynamicsOptions read_model_independent_options(const JsonView& analysis) {
  solver::ElastodynamicsOptions options;
  options.load_history = read_load_history(analysis);
  if (const auto approximations = analysis.find("effects"))
    options.nominal_inertia = approximations->get("nominal_inertia", true);
  options.time = read_time_options(analysis);
  options.time.quasi_static_start = analysis.text("initial_state") == "quasi-static";
  options.modal_superposition = analysis.get("modal_superposition", false);
  return options;
}

solver::ElastodynamicsOptions read_elastodynamics_options(const JsonView& analysis,
                                                          const CaseModel& case_model) {
  // Checks the restrictions of rigid-link dynamics, which apply to elastodynamics as well.
  static_cast<void>(read_rigid_manipulator(analysis, case_model));
  if (!case_model.path)
    throw analysis.error("elastodynamics requires a model with 'trajectory' (got 'pose')");
  if (!loads_at_P_only(case_model))
    throw analysis.error("elastodynamics supports only loads at node P (got C1, C2 or C3)");
  solver::ElastodynamicsOptions options = read_model_independent_options(analysis);
  const solver::Effects effects = case_model.effects;
  options.design = solver::restrict_effects(*case_model.manipulator, effects);
  options.path = *case_model.path;
  for (const solver::NodalLoad& load : case_model.structure.loads) options.wrench += load.force;
  if (effects.has(solver::Effect::gravity)) options.gravity = case_model.structure.gravity;
  options.damping = {.mass = 0, .stiffness = 0};
  if (effects.has(solver::Effect::damping))
    options.damping = read_rayleigh(analysis.find("damping"));
  options.elastic_inertia = effects.has(solver::Effect::inertia);
  options.gyroscopic = effects.has(solver::Effect::gyroscopic);
  if (const auto approximations = analysis.find("effects")) {
    const bool rates = approximations->get("transformation_rate_terms", false);
    if (rates && !approximations->get("elastic_inertia", true))
      throw(*approximations)["transformation_rate_terms"].error(
          "these terms belong to the elastic inertia; expected also 'elastic_inertia': true");
  }
  if (options.modal_superposition && !solver::is_at_rest(options.path))
    throw analysis["modal_superposition"].error(
        "modal superposition requires constant mass and stiffness, and thus a platform at rest");
  for (const solver::TrajectoryPoint& point : case_model.motion)
    options.time.sample_times.push_back(point.time);
  options.time.start = options.time.sample_times.front();
  options.time.end = options.time.sample_times.back();
  if (!(options.time.end > options.time.start))
    throw analysis.error("the trajectory requires at least two points (got one)");
  if (!analysis.has("step_s")) {
    options.time.step = kDefaultStep * (options.time.end - options.time.start);
  } else if (options.elastic_inertia) {
    limit_time_step_count(analysis["step_s"], options.time.end - options.time.start);
  }
  return options;
}

StepResult analyze_elastodynamics(const JsonView& analysis, const CaseModel& case_model, bool draw,
                                  Recorder& record) {
  const solver::ElastodynamicsOptions options = read_elastodynamics_options(analysis, case_model);
  const bool large = case_model.effects.has(solver::Effect::large_displacement);
  const solver::ElastodynamicsSolution solution = solve(options, large);
  StepResult result{solution.outcome, solution.summary.counters, solution.evidence};
  const solver::System start = solver::assemble(build_model(case_model, 0));
  if (draw) result.drawing = draw_model(start, true);
  if (!solution.outcome.solved()) return result;
  const StateRecorder recorder(start.model, "elastodynamics");
  for (std::size_t i = 0; i < solution.state.size(); ++i) {
    recorder.record({solution.state[i]}, record);
    if (!large) warn_of_rotation(largest_rotation(solution.state[i]), result.warnings);
    warn_of_strain(start.model, solution.state[i], result.warnings);
    if (large) continue;
    record.add("equilibrium_residual_N", solution.state[i].equilibrium_residual);
    record.add("moment_residual_N_m", solution.state[i].moment_residual);
  }
  if (!large) warn_of_redundant_constraints(start, result.warnings);
  record_deflection(solution, record);
  record_torques(solution, record);
  record_energy(solution, !options.elastic_inertia, record);
  // A mechanism with free active joints has no quasi-static position.
  const Eigen::MatrixX2d& slow = solution.quasi_static_deflection;
  if (options.elastic_inertia && slow.allFinite())
    record_distance("dynamic_to_quasi_static_difference", slow, solution.deflection, record);
  if (analysis.get("step_errors", false)) record_step_errors(options, large, solution, record);
  if (options.elastic_inertia) record_damping(options.damping, start, record);
  record_motion_summary(solution, record);
  if (result.drawing && !large) draw_motion(case_model, solution, *result.drawing);
  return result;
}

}  // namespace trammel::harness
