#include "solver/large/integrate_large_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "solver/large/state_results.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

void add_constraints(const ConstraintGaps& gaps, IntegrationSummary& summary) {
  ConstraintGaps& largest = summary.constraints;
  largest.position = nan_max(largest.position, gaps.position);
  largest.rate = nan_max(largest.rate, gaps.rate);
  largest.relative_position = nan_max(largest.relative_position, gaps.relative_position);
}

/// Integrates the motion from a state. `conservative` is the system if the energy-momentum method
/// is used, or null for generalized-alpha.
IntegrationSummary run(const ConstrainedSystem& system,
                       const GeometricallyExactSystem* conservative, State& state,
                       const TransientOptions& options, const Observer& observe) {
  IntegrationSummary summary;
  MotionResiduals residuals(system);
  const Observer look = [&](const State& at) {
    add_constraints(residuals.largest_gaps(at), summary);
    if (observe) observe(at);
  };
  TransientOptions from_state = options;
  from_state.start = state.t;
  const auto stepper = conservative
                           ? make_energy_momentum(*conservative, from_state, state, look)
                           : std::make_unique<ConstrainedStepper>(system, from_state, state, look);
  static_cast<TransientSummary&>(summary) =
      solver::integrate(*stepper, from_state, options.breakpoints, StepSizes::free);
  state = stepper->state();
  stepper->add_energy_residual(summary.evidence);
  summary.outcome = outcome_by_evidence(summary.outcome, summary.evidence,
                                        {Residual::equation_of_motion, Residual::constraints});
  summary.counters.factorizations = stepper->matrix().factorizations();
  summary.counters.solves = stepper->matrix().solves();
  return summary;
}

/// Returns the index of the coordinate to which an initial velocity applies. The result is -1 if a
/// support holds the coordinate or the node has no rotation.
Index velocity_coordinate(const GeometricallyExactSystem& system, const InitialVelocity& initial) {
  const Index k = system.layout().node[to_size(initial.node)][to_size(initial.direction)];
  return k < system.coordinate_count() ? k : -1;
}

/// Returns a prescribed initial velocity that the constraints do not admit, or null if they admit
/// all velocities. The velocity `left_out` is not checked.
const InitialVelocity* refused_velocity(const GeometricallyExactSystem& system, const State& state,
                                        const InitialVelocity* left_out = nullptr) {
  constexpr double kRounding = 1e-6;
  const VectorXd& scale = system.scale();
  const double fastest =
      state.v.size() > 0 ? state.v.cwiseQuotient(scale).lpNorm<Eigen::Infinity>() : 0.0;
  for (const InitialVelocity& initial : system.large_motion().initial_velocities) {
    const Index k = velocity_coordinate(system, initial);
    if (k < 0 || &initial == left_out) continue;
    const double missed = std::abs(state.v[k] - initial.value);
    if (missed > kRounding * std::max(std::abs(initial.value), fastest * scale[k])) return &initial;
  }
  return nullptr;
}

constexpr std::array kVelocityUnits = {" m/s", " m/s", " rad/s"};

/// Returns the part of the error message about an inadmissible initial velocity that follows "the
/// constraints do not let". An example is "node B start with 3 m/s along x".
std::string describe_start(const GeometricallyExactSystem& system, const InitialVelocity& initial) {
  constexpr std::array kDirections = {" along x", " along y", ""};
  const auto direction = static_cast<std::size_t>(initial.direction);
  std::ostringstream text;
  text << "node " << system.model().nodes[to_size(initial.node)].name << " start with "
       << initial.value << kVelocityUnits[direction] << kDirections[direction];
  return text.str();
}

/// Computes a consistent initial state of a model: displacements, velocities, accelerations and
/// multipliers.
Outcome initialize_state(const GeometricallyExactSystem& system, State& state, double step) {
  const std::vector<InitialVelocity>& initial_velocities = system.large_motion().initial_velocities;
  for (const InitialVelocity& initial : initial_velocities) {
    if (velocity_coordinate(system, initial) >= 0 || initial.value == 0) continue;
    return {Status::singular, "an initial velocity is given, but a support holds node " +
                                  system.model().nodes[to_size(initial.node)].name +
                                  ", or the node has no rotation"};
  }
  const auto start_without = [&](const InitialVelocity* left_out, State& start) {
    start = system.reference_state();
    PrescribedVelocities given;
    for (const InitialVelocity& initial : initial_velocities) {
      const Index k = velocity_coordinate(system, initial);
      if (k >= 0 && &initial != left_out) given.emplace_back(k, initial.value);
    }
    return make_consistent(system, start, given, step);
  };
  const Outcome consistent = start_without(nullptr, state);
  const InitialVelocity* refused = consistent.solved() ? refused_velocity(system, state) : nullptr;
  if (refused == nullptr) return consistent;
  std::ostringstream message;
  message.precision(9);
  message << "the constraints do not let " << describe_start(system, *refused);
  // Solve without the refused velocity. The result contains the velocity that the other prescribed
  // velocities and the constraints require at the same coordinate.
  State admitted;
  if (!start_without(refused, admitted).solved() || refused_velocity(system, admitted, refused)) {
    message << ", nor do the constraints admit the other given velocities";
  } else {
    constexpr double kRounding = 1e-9;
    const Index k = velocity_coordinate(system, *refused);
    const VectorXd& scale = system.scale();
    const double fastest = admitted.v.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
    const double value = admitted.v[k];
    message << (initial_velocities.size() > 1 ? ": with the other given velocities, " : ": ")
            << (std::abs(value) < kRounding * fastest * scale[k] ? 0.0 : value)
            << kVelocityUnits[static_cast<std::size_t>(refused->direction)] << " is admissible";
  }
  return {Status::singular, message.str()};
}

/// Checks if the states extrapolated from integrations with `step` and `step`/2 satisfy the
/// constraints. If errors of second order dominate in both integrations, the residuals of the
/// constraints are much smaller than the difference between the two integrations.
Outcome outcome_of_extrapolation(const IntegrationSummary& summary) {
  constexpr double kLimit = 1e-3;
  if (summary.constraints.relative_position <= kLimit) return {};
  std::ostringstream message;
  message << "the time steps are too long to be extrapolated: the motion extrapolated from two "
             "step sizes violates a constraint by "
          << summary.constraints.relative_position << " times the model size or 1 rad";
  return {Status::not_converged, message.str()};
}

}  // namespace

IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                             const TransientOptions& options, const Observer& observe) {
  return run(system, nullptr, state, options, observe);
}

IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                             const TransientOptions& options, const Observer& observe) {
  IntegrationSummary summary;
  summary.outcome = initialize_state(system, state, options.step);
  if (!summary.outcome.solved()) return summary;
  const bool conserves = options.scheme.conserves_energy;
  const double start = state.t;
  MemberBalance balance;
  Outcome recovered;
  summary = run(system, conserves ? &system : nullptr, state, options, [&](const State& at) {
    // Exclude the first state from the check of the equilibrium of the members. If the step does
    // not resolve all vibrations, the first accelerations are those of an implicit step and do not
    // satisfy the equation of motion.
    if (at.t > start && !conserves) balance.add_state(system, at);
    if (!observe) return;
    if (at.t == start || !conserves) return observe(at);
    // The multipliers of an energy-momentum step are mean values, which oscillate about the exact
    // multipliers. Output multipliers therefore follow from positions and velocities.
    State shown = at;
    if (recovered.solved()) recovered = make_accelerations_consistent(system, shown, options.step);
    observe(shown);
  });
  if (summary.outcome.solved()) summary.outcome = recovered;
  if (!conserves) summary.evidence.add(Residual::equation_of_motion, balance.residual());
  summary.outcome = outcome_by_evidence(summary.outcome, summary.evidence);
  if (!summary.outcome.solved())
    summary.outcome.reason += drive_conflicts_text(system, state, options.step);
  return summary;
}

IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system, State& state,
                                          const TransientOptions& options,
                                          const Observer& observe) {
  TransientOptions fixed = options;
  fixed.adaptive.reset();
  if (fixed.sample_times.empty())
    fixed.sample_times = even_times(options.start, options.end, options.step);
  std::vector<State> coarse;
  const auto keep = [&](const State& s) { coarse.push_back(s); };
  IntegrationSummary summary = integrate(system, state, fixed, keep);
  if (!summary.outcome.solved()) return summary;
  fixed.step /= 2;
  fixed.steps_in_multiples_of *= 2;
  summary.constraints = {};
  std::size_t next = 0;
  State extrapolated;
  MotionResiduals residuals(system);
  const auto combine = [&](const State& fine) {
    const State& other = coarse[std::min(next++, coarse.size() - 1)];
    extrapolated = fine;
    extrapolated.q += (fine.q - other.q) / 3;
    extrapolated.v += (fine.v - other.v) / 3;
    extrapolated.lambda += (fine.lambda - other.lambda) / 3;
    add_constraints(residuals.largest_gaps(extrapolated), summary);
    if (observe) observe(extrapolated);
  };
  const IntegrationSummary second = integrate(system, state, fixed, combine);
  state = extrapolated;
  summary.outcome = second.outcome;
  summary.evidence.add(second.evidence);
  summary.accepted += second.accepted;
  summary.rejected += second.rejected;
  summary.iterations += second.iterations;
  summary.smallest_step = second.smallest_step;
  summary.counters += second.counters;
  if (summary.outcome.solved()) summary.outcome = outcome_of_extrapolation(summary);
  return summary;
}

}  // namespace trammel::solver::large_motion
