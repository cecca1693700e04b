#include "solver/elastodynamics/elastodynamics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/elastodynamics/elastodynamics_recorder.h"
#include "solver/elastodynamics/path_follower.h"
#include "solver/modes/modes.h"
#include "solver/time/modal_superposition.h"
#include "solver/time/motion_evidence.h"
#include "solver/time/transient_start.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

std::vector<double> sample_times(const TransientOptions& options) {
  if (!options.sample_times.empty()) return options.sample_times;
  if (!(options.step > 0 && options.end > options.start)) {
    throw ModelError("a motion ends after it starts, and its step is positive");
  }
  return even_times(options.start, options.end, options.step);
}

/// Written anew at every time, unless the platform stands still.
EquationOfMotion equation_of(const ElastodynamicsOptions& options, PathFollower& follower) {
  EquationOfMotion equation;
  equation.M = equation.K = follower.system().K();
  if (follower.damped() || options.gyroscopic) equation.C = follower.system().K();
  follower.matrices(equation.M, equation.C, equation.K);
  // Where there is no pose the numbers end, and with them the integration.
  equation.load = [&follower](double time, VectorXd& f) {
    if (follower.update_to(time)) {
      f = follower.load();
    } else {
      f.setConstant(kNaN);
    }
  };
  if (!options.load_history.constant()) equation.breakpoints = options.load_history.time;
  if (options.gyroscopic) {
    equation.working_motion = [&follower](double time, const VectorXd& q, const VectorXd& v) {
      follower.update_to(time);  // where there is no pose the numbers have ended before
      return follower.working_motion(q, v);
    };
  }
  if (!follower.stands_still()) {
    equation.update = [&follower](double time, SparseMatrix& M, SparseMatrix& C, SparseMatrix& K) {
      if (follower.update_to(time)) follower.matrices(M, C, K);
    };
  }
  return equation;
}

/// K q = F + f at every sample.
void solve_quasi_statically(const ElastodynamicsOptions& options, PathFollower& follower,
                            ElastodynamicsRecorder& recorder, ElastodynamicsSolution& solution) {
  const std::vector<double> times = sample_times(options.time);
  VectorXd q;
  const VectorXd still = VectorXd::Zero(follower.system().K().rows());
  const EquationOfMotion equation = equation_of(options, follower);
  MotionEvidence evidence(equation);
  for (const double time : times) {
    const bool begins = time == options.time.start;
    const double load_time = begins ? time : options.load_history.end_of_step(time);
    if (!follower.update_to(load_time)) return;
    if (!follower.solve_statically(follower.load(), q)) {
      solution.outcome = {Status::singular,
                          "the stiffness is singular: free joints have no quasi-static position"};
      return;
    }
    evidence.add_equilibrium(time, load_time, q, still, still, options.time.step);
    MotionEnergy energy;
    energy.strain = q.dot(follower.system().K() * q) / 2;
    recorder.record(time, q, still, still, energy, load_time);
    solution.summary.time = time;
  }
  solution.evidence = evidence.result();
}

/// What acts at the pose the follower is at, and the wrench by its history.
PiecewiseLinearLoad load_in_time(const ElastodynamicsOptions& options, const PathFollower& follower,
                                 const VectorXd& f) {
  const LoadHistory& history = options.load_history;
  if (history.constant()) return step_load(f, options.time.start);
  const System& start = follower.system().start();
  const VectorXd applied = start.T.transpose() * start.load;
  return load_by_history(history, applied, f - history.at(options.time.start) * applied);
}

/// All modes at every sample, each by its closed form.
void superpose_modes(const ElastodynamicsOptions& options, PathFollower& follower,
                     ElastodynamicsRecorder& recorder, ElastodynamicsSolution& solution) {
  const std::vector<double> times = sample_times(options.time);
  if (!follower.stands_still()) {
    throw ModelError("modes are superposed where the matrices are constant: the platform moves");
  }
  if (options.gyroscopic) throw ModelError("a platform that stands still has no gyroscopic terms");
  const SparseMatrix& M = follower.system().M();
  const SparseMatrix& K = follower.system().K();
  const VectorXd f = follower.load();
  VectorXd q0 = VectorXd::Zero(f.size());
  if (options.time.quasi_static_start && !follower.solve_statically(f, q0)) {
    solution.outcome = {Status::singular, "the stiffness is singular: no quasi-static start"};
    return;
  }
  std::vector<double> from_start = {options.time.start};
  from_start.insert(from_start.end(), times.begin(), times.end());
  const ModalBasis basis = all_modes(M, K);
  solution.outcome = basis.outcome;
  if (!basis.outcome.solved()) return;
  const ModalResponse response =
      superpose(basis, decay_rates(options.damping, basis.omega), M,
                load_in_time(options, follower, f), from_start, q0, VectorXd::Zero(f.size()));
  const double strain_at_start = q0.dot(K * q0) / 2;
  const EquationOfMotion equation = equation_of(options, follower);
  MotionEvidence evidence(equation);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto column = static_cast<Index>(i) + 1;
    const VectorXd q = response.q.col(column);
    const VectorXd v = response.v.col(column);
    evidence.add_equilibrium(times[i], times[i], q, v, response.a.col(column), options.time.step);
    MotionEnergy energy;
    energy.kinetic = v.dot(M * v) / 2;
    energy.strain = q.dot(K * q) / 2;
    // Of a load that changes nobody keeps account here.
    energy.work = options.load_history.constant() ? f.dot(q - q0) : kNaN;
    // What is missing has been dissipated; without damping it shows the round-off.
    const bool damped = options.damping.mass != 0 || options.damping.stiffness != 0;
    if (damped) energy.dissipated = strain_at_start + energy.work - energy.kinetic - energy.strain;
    recorder.record(times[i], q, v, response.a.col(column), energy);
    solution.summary.time = times[i];
  }
  solution.evidence = evidence.result();
}

void find_first_frequency(const ElastodynamicsOptions& options, const System& start,
                          ElastodynamicsEffects& effects) {
  const ModalSolution modes = solve_modes(start, {.count = 4});  // three may be rigid
  const auto first = std::find_if(modes.frequency.begin(), modes.frequency.end(),
                                  [](double frequency) { return frequency > 0; });
  if (first == modes.frequency.end()) return;
  effects.first_frequency = *first;
  effects.damping_ratio = damping_ratio(options.damping, 2 * std::numbers::pi * *first);
}

/// K q = f - T^T C u., with the velocity of K q = f. Elastic inertia does not enter: its terms
/// depend, one by one, on which coordinates are free.
Outcome start_with_rates(const ElastodynamicsOptions& options, PathFollower& follower,
                         TransientOptions& time, Counters& counters) {
  EquationOfMotion equation = equation_of(options, follower);
  equation.C = {};
  equation.K = follower.system().K();
  if (equation.update) {
    equation.update = [&follower](double now, SparseMatrix&, SparseMatrix&, SparseMatrix& K) {
      if (follower.update_to(now)) K.coeffs() = follower.system().K().coeffs();
    };
  }
  EquationMatrices matrices(equation);
  time.quasi_static_start = false;
  time.q0.setZero(equation.K.rows());
  time.v0.setZero(equation.K.rows());
  Outcome outcome = start_quasi_statically(matrices, options.time, time.q0, time.v0, counters);
  if (!outcome.solved() || !follower.damped() || !follower.update_to(time.start)) return outcome;
  const VectorXd drag = follower.working_motion(time.q0, time.v0).drag;
  const VectorXd f = follower.load() - follower.system().constraints().T.transpose() * drag;
  // T. q changes with q: of the velocities that suit it, take the one whose strains stay.
  VectorXd q, change;
  if (!follower.solve_statically(f, q) ||
      !follower.solve_statically(follower.system().K_T_dot() * (q - time.q0), change)) {
    return {Status::singular, "the stiffness is singular: there is no quasi-static start"};
  }
  time.v0 -= change;
  time.q0 = q;
  return outcome;
}

/// Where inextensible links move and the rates of T are left out, it depends on the axes what work
/// free coordinates do.
bool work_depends_on_axes(const ElastodynamicsOptions& options, const PathFollower& follower) {
  const auto& rows = follower.system().constraints().rows;
  return !options.gyroscopic && !follower.stands_still() &&
         std::any_of(rows.begin(), rows.end(), [](const ConstraintRow& row) {
           return row.source == ConstraintRow::Source::inextensible;
         });
}

/// By a scheme.
void integrate(const ElastodynamicsOptions& options, PathFollower& follower,
               ElastodynamicsRecorder& recorder, ElastodynamicsSolution& solution) {
  TransientOptions time = options.time;
  Counters start;
  if (options.gyroscopic && time.quasi_static_start) {
    solution.outcome = start_with_rates(options, follower, time, start);
    if (!solution.outcome.solved()) return;
  }
  const bool no_work = work_depends_on_axes(options, follower);
  const EquationOfMotion equation = equation_of(options, follower);
  solution.summary = solve_transient(equation, time, [&](const MotionSample& sample) {
    const bool begins = sample.time == options.time.start;
    const double load_time = begins ? sample.time : options.load_history.end_of_step(sample.time);
    if (sample.index < 0) {
      recorder.add_balance(load_time, sample.q, sample.v, sample.a);
    } else {
      MotionEnergy energy = sample.energy;
      if (no_work) energy.work = energy.dissipated = kNaN;
      recorder.record(sample.time, sample.q, sample.v, sample.a, energy, load_time,
                      sample.interpolated);
    }
  });
  solution.summary.counters += start;
  solution.outcome = solution.summary.outcome;
  solution.evidence = solution.summary.evidence;
}

}  // namespace

ElastodynamicsSolution solve_elastodynamics(const ElastodynamicsOptions& options) {
  if (options.gyroscopic && !options.elastic_inertia) {
    throw ModelError(
        "gyroscopic terms are inertia of the elastic motion: without it there are none");
  }
  ElastodynamicsSolution solution;
  PathFollower follower(options, options.time.start);
  ElastodynamicsRecorder recorder(options, follower, solution);
  if (!follower.update_to(options.time.start)) {
    solution.outcome = follower.outcome();
    return solution;
  }
  if (options.elastic_inertia) {
    find_first_frequency(options, follower.system().start(), solution.effects);
  }
  if (!options.elastic_inertia) {
    solve_quasi_statically(options, follower, recorder, solution);
  } else if (options.modal_superposition) {
    superpose_modes(options, follower, recorder, solution);
  } else {
    integrate(options, follower, recorder, solution);
  }
  if (!follower.outcome().solved()) solution.outcome = follower.outcome();
  if (!solution.state.empty())
    solution.evidence.add(Residual::equation_of_motion, recorder.balance());
  solution.outcome =
      outcome_by_evidence(solution.outcome, solution.evidence, {Residual::equation_of_motion});
  solution.summary.counters += follower.counters();
  recorder.finish();
  return solution;
}

}  // namespace trammel::solver
