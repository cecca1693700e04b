#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "harness/base/recorder.h"
#include "harness/input/json_view.h"
#include "harness/motion/analyses.h"
#include "harness/readers/field_reader.h"
#include "harness/readers/option_reader.h"
#include "harness/scene/observables.h"
#include "harness/statics_modes/range_warnings.h"
#include "harness/statics_modes/reduced_system.h"
#include "solver/linear/element_operators.h"
#include "solver/linear/modes.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/model/evidence.h"
#include "solver/model/numbers.h"
#include "solver/motion/modal_superposition.h"
#include "solver/motion/motion_evidence.h"
#include "solver/motion/rotating_frame_transient.h"
#include "solver/motion/transient.h"

namespace trammel::harness {
namespace {

using Eigen::VectorXd;

/// Computed motion of a model at the sample times.
struct MotionHistory {
  solver::Outcome outcome;
  solver::Evidence evidence;
  solver::Counters counters;
  std::vector<double> time;         ///< [s]
  std::vector<double> load_factor;  ///< factor of the loads (without weight) at each time
  /// Factors of the loads (row 0) and of the weight (row 1) at each time, delayed by damping. Each
  /// delayed factor is the solution y of
  ///   t y' + y = factor,
  /// where t is the coefficient of stiffness-proportional damping [s]. The matrix is empty if the
  /// model has no stiffness-proportional damping.
  Eigen::MatrixXd followed_factor;
  Eigen::MatrixXd q, v, a;         ///< one row per coordinate, one column per time
  solver::ViscousDamping damping;  ///< Rayleigh and modal damping
  std::int64_t steps = 0;          ///< number of time steps; 0 for modal superposition
};

/// Returns the loads multiplied by the load history, and the weight, which is constant.
solver::PiecewiseLinearLoad time_dependent_load(const solver::System& system,
                                                const solver::LoadHistory& history) {
  const VectorXd weight = system.T.transpose() * system.weight;
  return load_by_history(history, system.f - weight, weight);
}

solver::TimeScheme read_scheme(const JsonView& transient) {
  const auto method = transient.find("method");
  if (!method) return solver::average_acceleration();
  if (const auto stated = method->find("newmark"))
    return solver::newmark(stated->number("beta"), stated->number("gamma"));
  if (method->has("hht_alpha")) return solver::hht_alpha(method->number("hht_alpha"));
  if (method->has("spectral_radius"))
    return solver::generalized_alpha(method->number("spectral_radius"));
  const auto word = method->get<std::string>();
  if (word == "linear-acceleration") return solver::linear_acceleration();
  return word == "central-difference" ? solver::central_difference()
                                      : solver::average_acceleration();
}

bool uses_modal_superposition(const JsonView& transient) {
  return transient.has("method") && transient["method"].json() == "modal-superposition";
}

struct InitialState {
  Eigen::VectorXd q0, v0;
};

/// Returns the velocity of the free coordinates that is closest to a uniform velocity of all nodes,
/// in the norm of kinetic energy. Supported nodes have velocity 0. Coordinates without mass
/// minimize the strain rate energy instead.
Eigen::VectorXd uniform_motion(const solver::System& system, const Eigen::Vector2d& velocity) {
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(system.coordinates.size);
  for (const auto& node : system.coordinates.node) {
    wanted[node[0]] = velocity.x();
    wanted[node[1]] = velocity.y();
  }
  for (const solver::ConstraintRow& row : system.constraints.rows)
    if (row.source == solver::ConstraintRow::Source::support) wanted[row.terms.front().first] = 0;
  const Eigen::VectorXd momentum = system.T.transpose() * solver::inertia_forces(system, wanted);
  return solver::RegularizedMass(system).solve(momentum);
}

InitialState read_initial_state(const JsonView& transient, const solver::System& system,
                                solver::Outcome& outcome) {
  const auto initial = transient.find("initial_state");
  if (!initial || initial->json() == "at-rest") return {};
  if (initial->json() == "static-equilibrium") {
    const solver::StaticSolution statics = solver::solve_statics(system);
    outcome = statics.outcome;
    return {statics.q, {}};
  }
  return {{}, uniform_motion(system, read_point((*initial)["velocity_m_per_s"]))};
}

std::vector<double> sample_times(const JsonView& transient) {
  const double duration = transient.number("duration_s");
  limit_time_step_count(transient["step_s"], duration);
  const double steps = std::ceil(duration / transient.number("step_s") * (1 - 1e-12));
  constexpr double most_samples = 10000;
  const auto count = transient.get<std::size_t>(
      "samples", static_cast<std::size_t>(std::clamp(steps, 1.0, most_samples)));
  std::vector<double> times;
  for (std::size_t i = 0; i <= count; ++i)
    times.push_back(
        std::min(duration, duration * static_cast<double>(i) / static_cast<double>(count)));
  return times;
}

/// Reads the rotating axes in which the motion is described.
solver::PrescribedRotation read_axes(const JsonView& transient) {
  for (const char* key : {"load_history", "initial_state"})
    if (transient.has(key)) throw transient[key].error("this key excludes 'rotating_frame'");
  const JsonView place = transient["rotating_frame"];
  solver::PrescribedRotation axes;
  axes.speed = [law = read_motion_law(place["law"])](double time) {
    const std::array<double, 3> motion = law(time);
    return std::array<double, 2>{motion[1], motion[2]};
  };
  if (place.has("center_m")) axes.center = read_point(place["center_m"]);
  axes.stiffening = place.get("geometric_stiffening", true);
  return axes;
}

class Motion {
 public:
  Motion(const JsonView& transient, const solver::System& system, bool damped)
      : transient_(transient),
        system_(system),
        damped_(damped),
        factor_(read_load_history(transient)),
        load_(time_dependent_load(system, factor_)) {}

  MotionHistory run() {
    history_.counters = system_.counters;
    if (damped_) history_.counters.add(solver::Effect::damping, 1);
    history_.time = sample_times(transient_);
    initial_ = read_initial_state(transient_, system_, history_.outcome);
    if (!history_.outcome.solved()) return history_;
    for (const double t : history_.time) {
      const bool integrated = !uses_modal_superposition(transient_) && t > history_.time.front();
      history_.load_factor.push_back(factor_.at(integrated ? factor_.step_end_load_time(t) : t));
    }
    if (uses_modal_superposition(transient_)) {
      superpose_modes();
    } else {
      integrate();
    }
    if (const double relaxation = history_.damping.rayleigh.stiffness; relaxation > 0) {
      const auto initial = transient_.find("initial_state");
      const bool held = initial && initial->json() == "static-equilibrium";
      history_.followed_factor =
          solver::delayed_factors(load_, relaxation, VectorXd::Constant(2, held ? 1 : 0),
                                  history_.time)
              .value;
    }
    return history_;
  }

 private:
  void integrate() {
    solver::EquationOfMotion equation;
    equation.M = system_.M;
    equation.K = system_.K;
    if (!damp(equation)) return;
    if (transient_.has("rotating_frame")) {
      history_.outcome = solver::add_rotating_frame_terms(system_, read_axes(transient_), equation);
      if (!history_.outcome.solved()) return;
    } else {
      load_.apply_to(equation);
    }
    solver::TransientOptions options;
    options.end = transient_.number("duration_s");
    options.step = transient_.number("step_s");
    options.scheme = read_scheme(transient_);
    options.sample_times = history_.time;
    options.q0 = initial_.q0;
    options.v0 = initial_.v0;
    if (const auto control = transient_.find("error_control"))
      options.adaptive = solver::ErrorControl{control->number("relative")};
    solver::TransientHistory found = solver::solve_transient(equation, options);
    history_.outcome = found.summary.outcome;
    history_.evidence = found.summary.evidence;
    history_.steps = found.summary.accepted;
    history_.counters += found.summary.counters;
    history_.q = std::move(found.q);
    history_.v = std::move(found.v);
    history_.a = std::move(found.a);
  }

  [[nodiscard]] solver::HarmonicDamping stated_damping(
      std::optional<solver::Index> modes = std::nullopt) const {
    return damped_ ? read_damping(transient_, modes) : solver::HarmonicDamping();
  }

  /// Adds the damping of the case to the equation of motion. Returns false if the modes that modal
  /// damping requires cannot be computed.
  bool damp(solver::EquationOfMotion& equation) {
    solver::HarmonicDamping damping = stated_damping();
    if (damping.modal_ratio.empty()) {
      damp(damping, {}, {}, equation);
      return true;
    }
    const solver::ModalSolution modes = solver::solve_modes(
        system_, {std::ssize(damping.modal_ratio), solver::EigenMethod::automatic});
    history_.outcome = modes.outcome;
    if (!modes.outcome.solved()) return false;
    damping = stated_damping(modes.frequency.size());
    damp(damping, 2 * std::numbers::pi * modes.frequency, modes.shape, equation);
    return true;
  }

  /// Adds Rayleigh and modal damping to the equation of motion.
  /// @param omega, shape  natural frequencies and mode shapes. They include all modes that have a
  ///   damping ratio.
  void damp(const solver::HarmonicDamping& damping, const Eigen::VectorXd& omega,
            const Eigen::MatrixXd& shape, solver::EquationOfMotion& equation) {
    equation.C = solver::damping_matrix(damping.rayleigh, system_.M, system_.K);
    history_.damping.rayleigh = damping.rayleigh;
    const auto count = std::min<solver::Index>(std::ssize(damping.modal_ratio), omega.size());
    if (count == 0) return;
    solver::ViscousDamping& modal = history_.damping;
    modal.omega = omega.head(count);
    modal.ratio = Eigen::Map<const VectorXd>(damping.modal_ratio.data(), count);
    modal.shape = shape.leftCols(count);
    equation.C += solver::modal_damping_matrix(system_.M, modal.omega, modal.shape, modal.ratio);
  }

  void superpose_modes() {
    if (transient_.has("error_control"))
      throw transient_["error_control"].error("this key excludes 'modal-superposition'");
    if (transient_.has("rotating_frame"))
      throw transient_["rotating_frame"].error("this key excludes 'modal-superposition'");
    const solver::ModalBasis basis = solver::all_modes(system_.M, system_.K);
    history_.outcome = basis.outcome;
    if (!basis.outcome.solved()) return;
    const solver::HarmonicDamping damping = stated_damping(basis.omega.size());
    Eigen::VectorXd decay = solver::decay_rates(damping.rayleigh, basis.omega);
    for (solver::Index i = 0; i < std::ssize(damping.modal_ratio); ++i)
      decay[i] += damping.modal_ratio[solver::to_size(i)] * basis.omega[i];
    solver::ModalResponse response =
        solver::superpose(basis, decay, system_.M, load_, history_.time, initial_.q0, initial_.v0);
    solver::add_massless_response(basis, system_.M, system_.K, damping.rayleigh.stiffness, load_,
                                  history_.time, initial_.q0, response, history_.counters);
    history_.q = std::move(response.q);
    history_.v = std::move(response.v);
    history_.a = std::move(response.a);
    solver::EquationOfMotion equation;
    equation.M = system_.M;
    equation.K = system_.K;
    damp(damping, basis.omega, basis.shape, equation);
    add_evidence(equation);
  }

  /// Computes the equilibrium residuals of modal superposition at the sample times, and adds them
  /// to the evidence of the solution.
  void add_evidence(solver::EquationOfMotion& equation) {
    load_.apply_to(equation);
    solver::MotionEvidence evidence(equation);
    for (solver::Index i = 0; i < history_.q.cols(); ++i) {
      const double time = history_.time[solver::to_size(i)];
      evidence.add_equilibrium(time, time, history_.q.col(i), history_.v.col(i), history_.a.col(i),
                               transient_.number("step_s"));
    }
    history_.evidence = evidence.result();
  }

  const JsonView& transient_;
  const solver::System& system_;
  bool damped_;
  solver::LoadHistory factor_;
  solver::PiecewiseLinearLoad load_;
  InitialState initial_;
  MotionHistory history_;
};

/// Returns the fraction of the initial velocity that a reduced basis cannot represent: the norm of
/// this part, relative to that of the full initial velocity. The norm is that of kinetic energy.
/// Returns 0 if there is no initial velocity.
double lost_velocity_fraction(const JsonView& transient, const solver::System& full,
                              const solver::System& reduced) {
  const auto initial = transient.find("initial_state");
  if (!initial || !initial->has("velocity_m_per_s")) return 0;
  const Eigen::Vector2d velocity = read_point((*initial)["velocity_m_per_s"]);
  const auto kinetic_energy = [&](const solver::System& system) {
    const Eigen::VectorXd v = uniform_motion(system, velocity);
    return v.dot(system.M * v);
  };
  const double whole = kinetic_energy(full);
  return whole > 0 ? std::sqrt(std::max(0.0, 1 - kinetic_energy(reduced) / whole)) : 0;
}

/// Computes the motion for the analysis "transient". Damping acts only if it is one of `effects`.
/// @throws InputError  if the load history or the damping is invalid.
MotionHistory compute_motion(const JsonView& transient, const solver::System& system,
                             solver::Effects effects) {
  const bool damped = effects.has(solver::Effect::damping) && transient.has("damping");
  try {
    return Motion(transient, system, damped).run();
  } catch (const solver::ModelError& error) {
    throw transient.error(error.what());
  }
}

/// Returns the state of a model at one sample time, with section forces if an output requires them.
ModelState state_at_sample(const solver::System& system, const MotionHistory& motion,
                           const std::optional<solver::LateStrain>& late, solver::Index sample,
                           bool with_forces) {
  ModelState state;
  if (with_forces) {
    solver::ElasticState elastic;
    const Eigen::VectorXd v = motion.v.col(sample);
    elastic.u = system.T * (motion.q.col(sample) + motion.damping.rayleigh.stiffness * v);
    elastic.acceleration =
        system.T * (motion.a.col(sample) + damping_acceleration(motion.damping, system.M, v));
    elastic.load_factor = motion.load_factor[solver::to_size(sample)];
    elastic.constraint_forces =
        constraint_multipliers(system, elastic);  // these constraint forces include damping forces
    elastic.u = system.T * motion.q.col(sample);
    if (late) late->set_loads(motion.q.col(sample), motion.followed_factor.col(sample), elastic);
    postprocess(system, elastic, state);
  }
  state.displacement = solver::node_motion(system, motion.q.col(sample));
  state.velocity = solver::node_motion(system, motion.v.col(sample));
  state.acceleration = solver::node_motion(system, motion.a.col(sample));
  return state;
}

void record_peak_values(const MotionHistory& motion, const std::vector<Output>& outputs,
                        const Eigen::MatrixXd& values, Recorder& record) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const solver::Peak found =
        solver::peak(motion.time, values.row(static_cast<solver::Index>(i)).transpose());
    record.add("peak_" + outputs[i].name, found.value);
    record.add("peak_time_s", outputs[i].name, found.time);
  }
}

/// Warns if a reduced basis omits over 1 % of the initial velocity. A smaller omission is invisible
/// in a plot of the motion.
void warn_of_reduced_basis(double missing, std::vector<Warning>& warnings) {
  constexpr double kNoticed = 0.01;
  if (!(missing > kNoticed)) return;
  add_warning(
      warnings,
      {"the part of the initial velocity that the reduced basis cannot represent", missing, "",
       "relative to the initial velocity, in the norm of kinetic energy; a larger "
       "'reduction' represents more of it"});
}

void draw_motion(const solver::System& system, const MotionHistory& motion, Drawing& drawing) {
  std::vector<Eigen::VectorXd> q;
  for (solver::Index i = 0; i < motion.q.cols(); ++i) q.emplace_back(motion.q.col(i));
  for (const std::size_t i : samples_to_draw(q, drawing.nodes.size())) {
    const std::string label = time_label(motion.time[i]);
    drawing.poses.push_back(
        {label, drawing.nodes, motion.time[i], draw_shape(system, q[i], label).displacement});
  }
}

}  // namespace

StepResult analyze_transient(const JsonView& analysis, const CaseModel& case_model,
                             std::size_t step, bool draw, Recorder& record) {
  if (case_model.path) throw analysis.error("this analysis requires one 'pose' (got 'trajectory')");
  if (analysis.has("reduction") && analysis.has("rotating_frame"))
    throw analysis["reduction"].error("this key excludes 'rotating_frame'");
  solver::System assembled = solver::assemble(build_model(case_model, step), case_model.effects);
  std::optional<solver::System> full;
  if (analysis.has("reduction")) full = assembled;
  const auto [outcome, system] = reduced_system(analysis, std::move(assembled));
  if (!outcome.solved()) return {outcome, system.counters};
  const std::vector<Output> outputs = read_outputs(analysis["outputs"], system.model);
  const bool with_forces = needs_forces(outputs);
  if (with_forces && analysis.has("rotating_frame"))
    throw analysis["outputs"].error(
        "with 'rotating_frame', expected only displacements, velocities and accelerations: "
        "section forces and stresses are not computed");
  const MotionHistory motion = compute_motion(analysis, system, case_model.effects);
  StepResult result{motion.outcome, motion.counters, motion.evidence};
  if (draw) result.drawing = draw_model(system, case_model.manipulator.has_value());
  if (!result.outcome.solved()) {
    if (analysis.has("reduction"))
      result.outcome.reason += "; more component modes may be needed for the loads along members";
    return result;
  }
  if (with_forces) warn_of_redundant_constraints(system, result.warnings);
  warn_of_taper(system.model, result.warnings);
  if (full) warn_of_reduced_basis(lost_velocity_fraction(analysis, *full, system), result.warnings);
  Eigen::MatrixXd values(std::ssize(outputs), std::ssize(motion.time));
  EnergyRecorder energy;
  std::optional<solver::LateStrain> late;
  if (with_forces && motion.followed_factor.size() > 0) late.emplace(system);
  for (solver::Index sample = 0; sample < values.cols(); ++sample) {
    const ModelState state = state_at_sample(system, motion, late, sample, with_forces);
    record.add("time_s", motion.time[solver::to_size(sample)]);
    for (solver::Index i = 0; i < values.rows(); ++i) {
      const Output& output = outputs[solver::to_size(i)];
      values(i, sample) = output.value(system.model, state);
      record.add(output.name, values(i, sample));
    }
    const Eigen::VectorXd q = motion.q.col(sample), v = motion.v.col(sample);
    const double kinetic = 0.5 * v.dot(system.M * v), strain = 0.5 * q.dot(system.K * q);
    energy.record(kinetic, strain, kinetic + strain, record);
    warn_of_rotation(largest_rotation(system, system.T * motion.q.col(sample)), result.warnings);
  }
  record_peak_values(motion, outputs, values, record);
  const bool is_free = system.load.isZero(0) && !analysis.has("rotating_frame");
  if (is_free && energy.largest_kinetic_energy() > 0)
    record.add("energy_drift", energy.relative_drift());
  record.add("steps", motion.steps);
  record.add("degrees_of_freedom", system.K.rows());
  if (result.drawing) draw_motion(system, motion, *result.drawing);
  return result;
}

}  // namespace trammel::harness
