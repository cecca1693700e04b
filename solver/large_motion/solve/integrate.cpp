#include "solver/large_motion/solve/integrate.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

#include "solver/large_motion/solve/energy_momentum.h"
#include "solver/large_motion/solve/generalized_alpha.h"
#include "solver/large_motion/solve/motion_residuals.h"
#include "solver/large_motion/solve/state_results.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// Residuals of the rigid constraints in the states that are observed.
class ConstraintResiduals {
 public:
  explicit ConstraintResiduals(const ConstrainedSystem& system)
      : system_(system), unit_(system.row_unit()) {}

  void take(const State& state, IntegrationSummary& summary) {
    residual_.setZero(system_.constraints());
    rate_.setZero(system_.constraints());
    system_.constraint_residual(state, residual_, rate_);
    for (Index r = 0; r < residual_.size(); ++r) {
      if (system_.compliance()[r] > 0) continue;
      summary.max_constraint_residual =
          std::max(summary.max_constraint_residual, std::abs(residual_[r]));
      summary.max_constraint_rate = std::max(summary.max_constraint_rate, std::abs(rate_[r]));
      summary.max_relative_constraint_residual =
          std::max(summary.max_relative_constraint_residual, std::abs(residual_[r]) / unit_[r]);
    }
  }

 private:
  const ConstrainedSystem& system_;
  VectorXd unit_, residual_, rate_;
};

/// Orientation of a mechanism's assembly: the sign of det G, or of det (G, v) with one degree of
/// freedom. It differs between the branches that meet at a singular position, and a step that is
/// longer than the gap between two branches takes the wrong one, with residuals of round-off.
class AssemblyBranch {
 public:
  explicit AssemblyBranch(const ConstrainedSystem& system) : system_(system) {
    const Index n = system.coordinates();
    const Index rigid = (system.compliance().array() == 0).count();
    freedom_ = n - rigid;
    constexpr Index kLargest = 64;  // the determinant is dense
    is_known_ =
        n > 0 && n <= kLargest && rigid == system.constraints() && (freedom_ == 0 || freedom_ == 1);
    if (is_known_) matrix_.emplace(n, rigid, system.blocks());
  }

  /// True if the orientation at the end of a step is the opposite of that at its start.
  [[nodiscard]] bool changes(const State& from, const State& to) {
    if (!is_known_) return false;
    if (last_.t != from.t) last_ = {from.t, orientation(from)};
    const Orientation next{to.t, orientation(to)};
    const VectorXd weight = system_.scale().cwiseAbs2().cwiseInverse();
    const bool reverses = freedom_ == 1 && from.v.cwiseProduct(weight).dot(to.v) < 0;
    if (last_.sign * next.sign * (reverses ? -1 : 1) < 0) return true;
    last_ = next;
    return false;
  }

 private:
  /// 0 if it is not known, as at a singular position or at rest.
  [[nodiscard]] double orientation(const State& state) {
    const Index n = system_.coordinates();
    TangentCoefficients coefficients;
    coefficients.has_penalty = false;
    matrix_->clear();
    system_.tangent(state, coefficients, *matrix_);
    Eigen::MatrixXd G(n, n);
    G.topRows(n - freedom_) = matrix_->constraint_gradient(system_.scale(), system_.row_unit());
    if (freedom_ == 1) {
      const VectorXd rate = state.v.cwiseQuotient(system_.scale());
      const double speed = rate.norm();
      // A drive moves the mechanism as well: then its velocity has no orientation.
      if (speed == 0 || (G.topRows(n - 1) * rate).norm() > 1e-6 * speed) return 0;
      G.bottomRows<1>() = rate.normalized().transpose();
    }
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(G);
    return lu.matrixLU().diagonal().array().sign().prod() *
           static_cast<double>(lu.permutationP().determinant());
  }

  struct Orientation {
    double t = -std::numeric_limits<double>::infinity();
    double sign = 0;
  };

  const ConstrainedSystem& system_;
  Index freedom_ = 0;
  bool is_known_ = false;
  Orientation last_;  ///< of the end of the last step that kept it
  std::optional<KktMatrix> matrix_;
};

class TimeIntegration {
 public:
  TimeIntegration(const ConstrainedSystem& system, Stepper& stepper,
                  const IntegrationOptions& options, const Observer& observe)
      : stepper_(stepper),
        options_(options),
        observe_(observe),
        branch_(system),
        residuals_(system, stepper),
        constraints_(system) {}

  IntegrationSummary run(State& state) {
    start_time_ = state.t;
    set_step_limit();
    stepper_.begin(state);
    observe_state();
    double h = options_.step;
    summary_.min_step = h;
    for (std::int64_t output = 1; state_time() < options_.end_time; ++output) {
      const double target = next_target(output, h);
      if (!advance_over_breakpoints(target, h)) break;
      observe_state();
      if (!summary_.outcome.solved()) break;
    }
    state = stepper_.state();
    residuals_.add_energy(summary_.evidence);
    summary_.outcome = outcome_by_evidence(summary_.outcome, summary_.evidence,
                                           {Residual::equation_of_motion, Residual::constraints});
    summary_.counters.factorizations = stepper_.matrix().factorizations();
    summary_.counters.solves = stepper_.matrix().solves();
    return summary_;
  }

 private:
  double state_time() const { return stepper_.state().t; }

  /// With fixed steps, at most ten times as many as asked for (and 1000): steps that keep failing
  /// are made ever smaller, and the run must end.
  void set_step_limit() {
    max_steps_ = options_.max_steps;
    if (options_.adaptive) return;
    const double equal_steps = (options_.end_time - start_time_) / options_.step;
    const double stops =
        static_cast<double>(options_.steps_in_multiples_of) *
        static_cast<double>(options_.breakpoints.size() + options_.output_times.size());
    const double limit = 1000 + 10 * (equal_steps + stops);
    if (limit >= static_cast<double>(max_steps_)) return;
    max_steps_ = static_cast<std::int64_t>(limit);
    step_limit_reason_ = "steps keep failing, ten times as many as asked for are spent";
  }

  /// Where the next observation is: on the grid of outputs, or after one step.
  double next_target(std::int64_t output, double h) const {
    const double end = options_.end_time;
    const std::vector<double>& times = options_.output_times;
    if (static_cast<std::size_t>(output) <= times.size())
      return std::min(times[static_cast<std::size_t>(output) - 1], end);
    const double span = options_.output_step > 0 ? options_.output_step
                        : options_.adaptive      ? 0.0
                                                 : options_.step;
    double target = span > 0 ? start_time_ + static_cast<double>(output) * span : state_time() + h;
    if (target > end - 1e-9 * (span > 0 ? span : h)) target = end;
    return target;
  }

  bool advance_over_breakpoints(double target, double& h) {
    // Round-off error of a time that is a multiple of the output step: breakpoints that are farther
    // apart are integrated one by one, however short a pulse is.
    const double apart = 8 * kEps * std::max(std::abs(start_time_), std::abs(options_.end_time));
    bool bends = false;
    for (; next_breakpoint_ < options_.breakpoints.size(); ++next_breakpoint_) {
      const double time = options_.breakpoints[next_breakpoint_];
      if (time > target + apart) break;
      bends = time > target - apart;
      if (bends || time < state_time() + apart) continue;
      if (!advance_to(time, h)) return false;
      stepper_.restart();
    }
    if (!advance_to(target, h)) return false;
    if (bends) stepper_.restart();
    return true;
  }

  /// The largest of equal steps up to the target that are not above what was asked for.
  double equal_step(double target) const {
    const int multiple = options_.steps_in_multiples_of;
    const double span = target - state_time();
    return span / (multiple * std::ceil(span / (multiple * options_.step) * (1 - 1e-9)));
  }

  bool advance_to(double target, double& h) {
    const double longest =
        options_.adaptive ? std::numeric_limits<double>::infinity() : equal_step(target);
    int failures = 0;
    double failed_step = 0;
    while (state_time() < target) {
      if (summary_.steps + summary_.rejected >= max_steps_)
        return fail(step_limit_reason_, h, nullptr);
      const double remaining = target - state_time();
      // Equal steps up to the target: no tiny last one.
      const double allowed = failures > 0 ? h : std::min(h, longest);
      const double count = std::ceil(remaining / allowed * (1 - 1e-9));
      const double step = count <= 1 ? remaining : remaining / count;
      if (step < 1e-7 * options_.step && remaining > step)
        return fail("the step has become smaller than 1e-7 of the requested one", step, &attempt_);
      StepReport report = stepper_.attempt(step, count <= 1 ? target : state_time() + step);
      attempt_ = report;
      summary_.iterations += report.iterations;
      const double ratio = options_.adaptive ? report.error / options_.tolerance : 0.0;
      if (!report.converged || ratio > 1.5) {
        ++summary_.rejected;
        if (++failures > 30) return fail("no step converges", step, &report);
        h = report.converged ? step * std::clamp(0.85 / std::cbrt(ratio), 0.2, 0.8)
                             : retry(failed_step, step, failures);
        continue;
      }
      // A path through a singular position keeps its direction however short the step is.
      constexpr double kShortest = 1e-3;
      if (step > kShortest * options_.step && branch_.changes(stepper_.state(), stepper_.next())) {
        ++summary_.rejected;
        ++failures;
        h = step / 2;
        continue;
      }
      failed_step = 0;
      failures = 0;
      stepper_.accept();
      add_evidence(step);
      ++summary_.steps;
      summary_.min_step = std::min(summary_.min_step, step);
      if (options_.adaptive) {
        // What an output or a bend of the load cut short does not shrink the next step.
        const double wanted = step * 0.85 / std::cbrt(std::max(ratio, 1e-6));
        h = std::clamp(wanted, 0.3 * step, std::max(1.8 * step, h));
      } else {
        h = std::min(options_.step, 2 * h);
      }
    }
    return true;
  }

  /// After a step that does not converge: a smaller one, and every second time a larger one, since
  /// a singular position may lie within the step and beyond it the equations are regular again.
  static double retry(double& failed_step, double step, int failures) {
    if (failed_step == 0) failed_step = step;
    const double smaller = failed_step * std::pow(0.5, (failures + 1) / 2);
    return failures % 2 == 1 ? smaller : failed_step * (1 + 0.3 * failures / (1 + 0.1 * failures));
  }

  /// @param report  of the step that failed; null if none was tried
  bool fail(const std::string& why, double h, const StepReport* report) {
    std::ostringstream message;
    message << why << ": step " << summary_.steps + 1 << " at time " << state_time()
            << " s of size " << h << " s";
    if (report && report->iterations > 0) {
      message << ", last correction " << report->correction << " of the model's size after "
              << report->iterations << " iterations";
    } else {
      message << ", no correction" << (report ? ": the tangent is singular there" : "");
    }
    summary_.outcome = {Status::not_converged, message.str()};
    return false;
  }

  void add_evidence(double step) {
    residuals_.add_constraints(step, summary_.evidence);
    residuals_.take_energy();
    if (state_time() < next_look_ && state_time() < options_.end_time) return;
    next_look_ = state_time() + (options_.end_time - start_time_) / 200;
    residuals_.add_equation_of_motion(summary_.evidence);
  }

  void observe_state() {
    const State& state = stepper_.state();
    if (!state.q.allFinite() || !state.v.allFinite()) {
      fail("the motion is not finite", options_.step, nullptr);
      return;
    }
    constraints_.take(state, summary_);
    if (observe_) observe_(state);
  }

  Stepper& stepper_;
  const IntegrationOptions& options_;
  const Observer& observe_;
  AssemblyBranch branch_;
  IntegrationSummary summary_;
  MotionResiduals residuals_;
  ConstraintResiduals constraints_;
  double start_time_ = 0, next_look_ = 0;
  std::size_t next_breakpoint_ = 0;
  std::int64_t max_steps_ = 0;
  StepReport attempt_;  ///< the last one
  const char* step_limit_reason_ = "too many steps";
};

/// Of a start velocity; -1 where a support holds the node, or it has no rotation.
Index coordinate_of(const GeometricallyExactSystem& system, const InitialVelocity& initial) {
  const Index k = system.layout().node[static_cast<std::size_t>(initial.node)]
                                      [static_cast<std::size_t>(initial.direction)];
  return k < system.coordinates() ? k : -1;
}

/// A given velocity, but for one, that the constraints do not admit; null where they admit all.
const InitialVelocity* refused_velocity(const GeometricallyExactSystem& system, const State& state,
                                        const InitialVelocity* left_out = nullptr) {
  constexpr double kRounding = 1e-6;
  const VectorXd& scale = system.scale();
  const double fastest =
      state.v.size() > 0 ? state.v.cwiseQuotient(scale).lpNorm<Eigen::Infinity>() : 0.0;
  for (const InitialVelocity& initial : system.large_motion().initial_velocities) {
    const Index k = coordinate_of(system, initial);
    if (k < 0 || &initial == left_out) continue;
    const double missed = std::abs(state.v[k] - initial.value);
    if (missed > kRounding * std::max(std::abs(initial.value), fastest * scale[k])) return &initial;
  }
  return nullptr;
}

constexpr std::array kVelocityUnits = {" m/s", " m/s", " rad/s"};

/// A given velocity as text: "node B start with 3 m/s along x".
std::string describe_start(const GeometricallyExactSystem& system, const InitialVelocity& initial) {
  constexpr std::array kDirections = {" along x", " along y", ""};
  const auto direction = static_cast<std::size_t>(initial.direction);
  std::ostringstream text;
  text << "node " << system.model().nodes[static_cast<std::size_t>(initial.node)].name
       << " start with " << initial.value << kVelocityUnits[direction] << kDirections[direction];
  return text.str();
}

/// Where two runs differ by their leading error alone, what is combined meets the constraints far
/// better than either state resembles the other.
Outcome outcome_of_extrapolation(const IntegrationSummary& summary) {
  constexpr double kLimit = 1e-3;
  if (summary.max_relative_constraint_residual <= kLimit) return {};
  std::ostringstream message;
  message << "the steps are too long to be extrapolated: what the two runs give together misses a "
             "constraint by "
          << summary.max_relative_constraint_residual << " of the model's size or of 1 rad";
  return {Status::not_converged, message.str()};
}

}  // namespace

IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                             const IntegrationOptions& options, const Observer& observe) {
  GeneralizedAlpha stepper(system, options.spectral_radius);
  return TimeIntegration(system, stepper, options, observe).run(state);
}

namespace {

IntegrationSummary run_generalized_alpha(const GeometricallyExactSystem& system, State& state,
                                         const IntegrationOptions& options,
                                         const Observer& observe) {
  const ConstrainedSystem& equations = system;
  MemberBalance balance;
  const double start = state.t;
  IntegrationSummary summary = integrate(equations, state, options, [&](const State& at) {
    // What vibrates faster than a step starts with the acceleration of an implicit one.
    if (at.t > start) balance.add(system, at);
    if (observe) observe(at);
  });
  summary.evidence.add(Residual::equation_of_motion, balance.residual());
  summary.outcome = outcome_by_evidence(summary.outcome, summary.evidence);
  return summary;
}

IntegrationSummary run_energy_momentum(const GeometricallyExactSystem& system, State& state,
                                       const IntegrationOptions& options, const Observer& observe) {
  EnergyMomentum stepper(system);
  const double start = state.t;
  Outcome recovered;
  const auto show = [&](const State& at) {
    if (!observe) return;
    State shown = at;  // the multipliers of a step are means, which alternate about the motion's
    if (at.t > start && recovered.solved())
      recovered = make_accelerations_consistent(system, shown, options.step);
    observe(shown);
  };
  IntegrationSummary summary = TimeIntegration(system, stepper, options, show).run(state);
  if (summary.outcome.solved()) summary.outcome = recovered;
  return summary;
}

}  // namespace

IntegrationSummary integrate(const GeometricallyExactSystem& system, State& state,
                             const IntegrationOptions& options, const Observer& observe) {
  IntegrationSummary summary;
  summary.outcome = initialize_state(system, state, options.step);
  if (!summary.outcome.solved()) return summary;
  summary = options.integrator == Integrator::generalized_alpha
                ? run_generalized_alpha(system, state, options, observe)
                : run_energy_momentum(system, state, options, observe);
  if (!summary.outcome.solved())
    summary.outcome.reason += contradictory_drives(system, state, options.step);
  return summary;
}

IntegrationSummary integrate_extrapolated(const GeometricallyExactSystem& system, State& state,
                                          const IntegrationOptions& options,
                                          const Observer& observe) {
  IntegrationOptions fixed = options;
  fixed.adaptive = false;
  if (fixed.output_step <= 0) fixed.output_step = fixed.step;
  std::vector<State> coarse;
  const auto keep = [&](const State& s) { coarse.push_back(s); };
  IntegrationSummary summary = integrate(system, state, fixed, keep);
  if (!summary.outcome.solved()) return summary;
  fixed.step /= 2;
  fixed.steps_in_multiples_of *= 2;
  summary.max_constraint_residual = summary.max_constraint_rate = 0;
  summary.max_relative_constraint_residual = 0;
  std::size_t next = 0;
  State extrapolated;
  ConstraintResiduals constraints(system);
  const auto combine = [&](const State& fine) {
    const State& other = coarse[std::min(next++, coarse.size() - 1)];
    extrapolated = fine;
    extrapolated.q += (fine.q - other.q) / 3;
    extrapolated.v += (fine.v - other.v) / 3;
    extrapolated.lambda += (fine.lambda - other.lambda) / 3;
    constraints.take(extrapolated, summary);
    if (observe) observe(extrapolated);
  };
  const IntegrationSummary second = integrate(system, state, fixed, combine);
  state = extrapolated;
  summary.outcome = second.outcome;
  summary.evidence.add(second.evidence);
  summary.steps += second.steps;
  summary.rejected += second.rejected;
  summary.iterations += second.iterations;
  summary.min_step = second.min_step;
  summary.counters.factorizations += second.counters.factorizations;
  summary.counters.solves += second.counters.solves;
  if (summary.outcome.solved()) summary.outcome = outcome_of_extrapolation(summary);
  return summary;
}

Outcome initialize_state(const GeometricallyExactSystem& system, State& state, double step) {
  const std::vector<InitialVelocity>& initial_velocities = system.large_motion().initial_velocities;
  for (const InitialVelocity& initial : initial_velocities) {
    if (coordinate_of(system, initial) >= 0 || initial.value == 0) continue;
    return {Status::singular,
            "a start velocity is given where a support holds node " +
                system.model().nodes[static_cast<std::size_t>(initial.node)].name +
                ", or it has no rotation"};
  }
  const auto start_without = [&](const InitialVelocity* left_out, State& start) {
    start = system.reference_state();
    PrescribedVelocities given;
    for (const InitialVelocity& initial : initial_velocities) {
      const Index k = coordinate_of(system, initial);
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
  // The others determine it: a velocity that they leave free would not have been refused.
  State admitted;
  if (!start_without(refused, admitted).solved() || refused_velocity(system, admitted, refused)) {
    message << ", nor do they admit the other given velocities together";
  } else {
    constexpr double kRounding = 1e-9;
    const Index k = coordinate_of(system, *refused);
    const VectorXd& scale = system.scale();
    const double fastest = admitted.v.cwiseQuotient(scale).lpNorm<Eigen::Infinity>();
    const double value = admitted.v[k];
    message << (initial_velocities.size() > 1 ? ": with the other given velocities, " : ": ")
            << (std::abs(value) < kRounding * fastest * scale[k] ? 0.0 : value)
            << kVelocityUnits[static_cast<std::size_t>(refused->direction)] << " is admissible";
  }
  return {Status::singular, message.str()};
}

}  // namespace trammel::solver::large_motion
