#include "solver/large_motion/solve/integrate.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "solver/large_motion/solve/energy_momentum.h"
#include "solver/large_motion/solve/generalized_alpha.h"

namespace trammel::large {

namespace {

class Journey {
 public:
  Journey(const ConstrainedSystem& system, Stepper& stepper, const IntegrationOptions& options,
          const Observer& observe)
      : system_(system), stepper_(stepper), options_(options), observe_(observe) {}

  IntegrationSummary run(State& state) {
    begin_ = state.t;
    limit_steps();
    stepper_.begin(state);
    look();
    double h = options_.step;
    summary_.smallest_step = h;
    for (std::int64_t leg = 1; state_time() < options_.end_time; ++leg) {
      const double target = next_target(leg, h);
      if (!travel(target, h)) break;
      look();
      if (!summary_.outcome.solved()) break;
    }
    state = stepper_.state();
    summary_.counters.factorizations = stepper_.matrix().factorizations();
    summary_.counters.solves = stepper_.matrix().solves();
    return summary_;
  }

 private:
  double state_time() const { return stepper_.state().t; }

  /// Where steps fail again and again equal steps have become tiny: that must come to an end.
  void limit_steps() {
    most_steps_ = options_.steps;
    if (options_.adaptive) return;
    const double equal = (options_.end_time - begin_) / options_.step;
    const double enough = 1000 + 10 * equal;
    if (enough >= static_cast<double>(most_steps_)) return;
    most_steps_ = static_cast<std::int64_t>(enough);
    why_enough_ = "steps keep failing, ten times as many as asked for are spent";
  }

  /// Where the next observation is: on the grid of outputs, or after one step.
  double next_target(std::int64_t leg, double h) const {
    const double end = options_.end_time;
    const double span = options_.output_step > 0 ? options_.output_step
                        : options_.adaptive      ? 0.0
                                                 : options_.step;
    double target = span > 0 ? begin_ + static_cast<double>(leg) * span : state_time() + h;
    if (target > end - 1e-9 * (span > 0 ? span : h)) target = end;
    return target;
  }

  bool travel(double target, double& h) {
    int failures = 0;
    double tried = 0;
    while (state_time() < target) {
      if (summary_.steps + summary_.rejected >= most_steps_) return fail(why_enough_, h, {});
      const double left = target - state_time();
      // Equal steps up to the target, so that none is tiny.
      const double count = std::ceil(left / h * (1 - 1e-9));
      const double now = count <= 1 ? left : left / count;
      if (now < 1e-7 * options_.step && left > now) return fail("no step is small enough", now, {});
      StepReport report = stepper_.attempt(now);
      summary_.iterations += report.iterations;
      const double ratio = options_.adaptive ? report.error / options_.tolerance : 0.0;
      if (!report.converged || ratio > 1.5) {
        ++summary_.rejected;
        if (++failures > 30) return fail("no step converges", now, report);
        h = report.converged ? now * std::clamp(0.85 / std::cbrt(ratio), 0.2, 0.8)
                             : retry(tried, now, failures);
        continue;
      }
      tried = 0;
      failures = 0;
      stepper_.accept();
      ++summary_.steps;
      summary_.smallest_step = std::min(summary_.smallest_step, now);
      if (options_.adaptive) {
        h = now * std::clamp(0.85 / std::cbrt(std::max(ratio, 1e-6)), 0.3, 1.8);
      } else {
        h = std::min(options_.step, 2 * h);
      }
    }
    return true;
  }

  /// After a step that does not converge: a smaller one, but also a larger one now and then, since
  /// what is in the way may be a singular position to be stepped over.
  static double retry(double& tried, double now, int failures) {
    if (tried == 0) tried = now;
    const double smaller = tried * std::pow(0.5, (failures + 1) / 2);
    return failures % 2 == 1 ? smaller : tried * (1 + 0.3 * failures / (1 + 0.1 * failures));
  }

  bool fail(const std::string& why, double h, const StepReport& report) {
    std::ostringstream words;
    words << why << ": step " << summary_.steps + 1 << " at time " << state_time() << " s of size "
          << h << " s, last correction " << report.residual << " of the model's size after "
          << report.iterations << " iterations";
    summary_.outcome = {Status::not_converged, words.str()};
    return false;
  }

  void look() {
    const State& state = stepper_.state();
    if (!state.q.allFinite() || !state.v.allFinite()) {
      fail("the motion is not finite", options_.step, {});
      return;
    }
    gap_.setZero(system_.constraints());
    rate_.setZero(system_.constraints());
    system_.gaps(state, gap_, rate_);
    for (Index r = 0; r < gap_.size(); ++r) {
      if (system_.compliance()[r] > 0) continue;
      summary_.largest_gap = std::max(summary_.largest_gap, std::abs(gap_[r]));
      summary_.largest_gap_rate = std::max(summary_.largest_gap_rate, std::abs(rate_[r]));
    }
    if (observe_) observe_(state);
  }

  const ConstrainedSystem& system_;
  Stepper& stepper_;
  const IntegrationOptions& options_;
  const Observer& observe_;
  IntegrationSummary summary_;
  double begin_ = 0;
  std::int64_t most_steps_ = 0;
  const char* why_enough_ = "too many steps";
  VectorXd gap_, rate_;
};

}  // namespace

IntegrationSummary integrate(const ConstrainedSystem& system, State& state,
                             const IntegrationOptions& options, const Observer& observe) {
  GeneralizedAlpha stepper(system, options.spectral_radius);
  return Journey(system, stepper, options, observe).run(state);
}

IntegrationSummary integrate(const LargeSystem& system, State& state,
                             const IntegrationOptions& options, const Observer& observe) {
  const Outcome started = start_motion(system, state, options.step);
  if (!started.solved()) {
    IntegrationSummary summary;
    summary.outcome = started;
    return summary;
  }
  if (options.integrator == Integrator::generalized_alpha) {
    const ConstrainedSystem& equations = system;
    return integrate(equations, state, options, observe);
  }
  EnergyMomentum stepper(system);
  return Journey(system, stepper, options, observe).run(state);
}

IntegrationSummary integrate_extrapolated(const LargeSystem& system, State& state,
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
  std::size_t next = 0;
  State combined;
  const auto combine = [&](const State& fine) {
    const State& other = coarse[std::min(next++, coarse.size() - 1)];
    combined = fine;
    combined.q += (fine.q - other.q) / 3;
    combined.v += (fine.v - other.v) / 3;
    combined.lambda += (fine.lambda - other.lambda) / 3;
    if (observe) observe(combined);
  };
  const IntegrationSummary second = integrate(system, state, fixed, combine);
  state = combined;
  summary.outcome = second.outcome;
  summary.steps += second.steps;
  summary.rejected += second.rejected;
  summary.iterations += second.iterations;
  summary.smallest_step = second.smallest_step;
  summary.largest_gap = std::max(summary.largest_gap, second.largest_gap);
  summary.largest_gap_rate = std::max(summary.largest_gap_rate, second.largest_gap_rate);
  summary.counters.factorizations += second.counters.factorizations;
  summary.counters.solves += second.counters.solves;
  return summary;
}

Outcome start_motion(const LargeSystem& system, State& state, double step) {
  state = system.rest();
  GivenVelocities given;
  for (const StartVelocity& start : system.scenario().start) {
    const Index k =
        system.layout()
            .node[static_cast<std::size_t>(start.node)][static_cast<std::size_t>(start.direction)];
    if (k < 0 || k >= system.coordinates()) {
      return {Status::singular,
              "a start velocity is given where a support holds node " +
                  system.model().nodes[static_cast<std::size_t>(start.node)].name};
    }
    given.emplace_back(k, start.value);
  }
  return make_consistent(system, state, given, step);
}

}  // namespace trammel::large
