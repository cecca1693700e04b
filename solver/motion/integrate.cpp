#include "solver/motion/integrate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

struct Stop {
  double time = 0;
  bool sample = false, breakpoint = false;
};

/// Returns the stops: sample times, breakpoints after the start, and the end, in ascending order.
std::vector<Stop> make_stops(const TransientOptions& options, const std::vector<double>& samples,
                             const std::vector<double>& breakpoints) {
  // Round-off error of a time that is a multiple of a step [s]. If the distance of a breakpoint
  // from all other stops is larger, the breakpoint becomes a separate stop, so that short load
  // pulses are resolved.
  const double apart = 8 * kEps * std::max(std::abs(options.start), std::abs(options.end));
  std::vector<Stop> stops;
  for (const double time : samples) stops.push_back({time, true, false});
  if (stops.empty() || stops.back().time < options.end)
    stops.push_back({options.end, false, false});
  const auto samples_end = std::ssize(stops);
  double last = options.start;
  for (const double time : breakpoints) {
    if (!(time > last + apart)) continue;
    const auto end = stops.begin() + samples_end;
    const auto next =
        std::lower_bound(stops.begin(), end, time - apart,
                         [](const Stop& stop, double value) { return stop.time < value; });
    if (next == end) break;
    if (next->time <= time + apart) {
      next->breakpoint = true;
    } else {
      stops.push_back({time, false, true});
    }
    last = time;
  }
  std::inplace_merge(stops.begin(), stops.begin() + samples_end, stops.end(),
                     [](const Stop& a, const Stop& b) { return a.time < b.time; });
  return stops;
}

/// Returns the smallest number of equal steps in the time `span` [s] for which no step exceeds
/// `step` [s]. The number is a multiple of `multiple`.
double equal_step_count(double span, double step, int multiple = 1) {
  return multiple * std::max(1.0, std::ceil(span / (multiple * step) * (1 - 1e-9)));
}

/// Time steps of the size largest step / 2^level between two stops. The level changes by one at a
/// time.
class HalvedSteps {
 public:
  /// Largest accepted ratio of estimated error to allowed error.
  static constexpr double kErrorLimit = 1;
  explicit HalvedSteps(const TransientOptions& options) : options_(options) {}
  void begin(double time, double stop) {
    begin_ = time;
    end_ = stop;
    const double steps = std::min(1e12, equal_step_count(stop - time, options_.step));
    const double largest = (stop - time) / steps;
    if (!(std::abs(largest - largest_) <= 1e-12 * largest_)) largest_ = largest;
    size_ = std::ldexp(largest_, -level_);
    done_ = 0;
    count_ = static_cast<std::int64_t>(steps) << level_;
  }
  [[nodiscard]] Step next(double /*time*/) const {
    const bool last = done_ + 1 == count_;
    return {size_, last ? end_ : begin_ + static_cast<double>(done_ + 1) * size_, level_, last};
  }
  void accept(const Step& /*step*/, double error) {
    ++done_;
    if (level_ == 0 || error >= 0.125 || done_ % 2 != 0) return;
    --level_;
    size_ *= 2;
    done_ /= 2;
    count_ /= 2;
  }
  /// Halves the size of the next time steps. Returns null, or the reason if the integration fails.
  [[nodiscard]] const char* reject(const Step& /*step*/, const StepReport& report) {
    if (report.status != Status::solved) return "no solution of the step was found";
    if (++level_ > options_.adaptive->finest_level) return "the step size is at its minimum";
    size_ /= 2;
    done_ *= 2;
    count_ *= 2;
    return nullptr;
  }

 private:
  const TransientOptions& options_;
  double begin_ = 0, end_ = 0, largest_ = 0, size_ = 0;
  std::int64_t done_ = 0, count_ = 0;  ///< completed and total number of steps at the current level
  int level_ = 0;
};

/// Step sizes that follow from the estimated error. If a step does not converge, smaller and larger
/// sizes are tried.
class FreeSteps {
 public:
  static constexpr double kErrorLimit = 1.5;
  explicit FreeSteps(const TransientOptions& options) : options_(options), size_(options.step) {}
  void begin(double time, double stop) {
    stop_ = stop;
    longest_ = options_.adaptive ? std::numeric_limits<double>::infinity()
                                 : (stop - time) / equal_step_count(stop - time, options_.step,
                                                                    options_.steps_in_multiples_of);
    failures_ = 0;
    failed_size_ = 0;
  }
  /// Returns the next step. With fixed steps or given sample times, all steps up to a stop are
  /// equal, which avoids a tiny last step.
  [[nodiscard]] Step next(double time) const {
    const double remaining = stop_ - time;
    const double allowed = failures_ > 0 ? size_ : std::min(size_, longest_);
    const double count = std::ceil(remaining / allowed * (1 - 1e-9));
    if (count <= 1) return {remaining, stop_, 0, true};
    const bool every_step_is_shown = options_.adaptive && options_.sample_times.empty();
    const double size = every_step_is_shown ? allowed : remaining / count;
    return {size, time + size, 0, false};
  }
  void accept(const Step& step, double error) {
    failures_ = 0;
    failed_size_ = 0;
    if (!options_.adaptive) {
      size_ = std::min(options_.step, 2 * size_);
      return;
    }
    // A step that was shortened to end at a stop does not reduce the size of the next step.
    const double wanted = step.size * 0.85 / std::cbrt(std::max(error, 1e-6));
    size_ = std::clamp(wanted, 0.3 * step.size, std::max(1.8 * step.size, size_));
  }
  [[nodiscard]] const char* reject(const Step& step, const StepReport& report) {
    if (++failures_ > 30) return "30 attempts with different step sizes did not converge";
    if (report.status != Status::solved) {
      size_ = retry(step.size);
    } else if (report.leaves_branch) {
      size_ = step.size / 2;
    } else {
      size_ = step.size * std::clamp(0.85 / std::cbrt(report.error), 0.2, 0.8);
    }
    if (size_ >= 1e-7 * options_.step || step.last) return nullptr;
    return "the step size is below 1e-7 of the requested step";
  }

 private:
  /// Returns a new size for a step that did not converge. Smaller and larger sizes alternate,
  /// because a singular position may lie within the step. The equations are regular again after
  /// this position.
  double retry(double size) {
    if (failed_size_ == 0) failed_size_ = size;
    const double smaller = failed_size_ * std::pow(0.5, (failures_ + 1) / 2);
    const double larger = failed_size_ * (1 + 0.3 * failures_ / (1 + 0.1 * failures_));
    return failures_ % 2 == 1 ? smaller : larger;
  }

  const TransientOptions& options_;
  double stop_ = 0, longest_ = 0;
  double size_ = 0, failed_size_ = 0;
  int failures_ = 0;
};

template <class Control>
class TimeIntegration {
 public:
  TimeIntegration(Stepper& stepper, const TransientOptions& options)
      : stepper_(stepper),
        control_(options),
        options_(options),
        time_(options.start),
        next_look_(options.start) {}

  TransientSummary run(const std::vector<Stop>& stops) {
    set_step_limit(std::ssize(stops));
    stepper_.output_state();
    for (const Stop& stop : stops) {
      if (!advance(stop.time)) break;
      if (stop.breakpoint) stepper_.restart();
      if (stop.sample && stop.time > options_.start) stepper_.output_state();
    }
    summary_.time = time_;
    summary_.counters.steps = summary_.accepted + summary_.rejected;
    return std::move(summary_);
  }

 private:
  /// Sets the limit of the number of steps. With fixed steps, the limit is 1000 plus ten times the
  /// requested number. The limit ends integrations whose steps fail and become smaller and smaller.
  void set_step_limit(Index stops) {
    max_steps_ = options_.max_steps;
    if (options_.adaptive) return;
    const double steps = (options_.end - options_.start) / options_.step +
                         static_cast<double>(options_.steps_in_multiples_of * stops);
    const double limit = 1000 + 10 * steps;
    if (limit >= static_cast<double>(max_steps_)) return;
    max_steps_ = static_cast<std::int64_t>(limit);
    limit_reason_ = "too many steps failed: the limit is 1000 + 10 times the requested number";
  }

  bool advance(double stop) {
    if (!(time_ < stop)) return true;
    control_.begin(time_, stop);
    step_ = control_.next(time_);
    summary_.outcome = stepper_.begin(step_, stop);
    if (!summary_.outcome.solved()) {
      summary_.outcome.reason += " at " + describe_step();
      return false;
    }
    while (time_ < stop) {
      if (summary_.accepted + summary_.rejected >= max_steps_) return fail(limit_reason_);
      step_ = control_.next(time_);
      report_ = stepper_.attempt(step_);
      summary_.iterations += report_.iterations;
      if (report_.status != Status::solved || report_.error > Control::kErrorLimit ||
          report_.leaves_branch) {
        ++summary_.rejected;
        if (const char* reason = control_.reject(step_, report_)) return fail(reason);
        continue;
      }
      accept();
    }
    return true;
  }

  void accept() {
    const bool check_motion = step_.end >= next_look_ || step_.end >= options_.end;
    if (check_motion) next_look_ = step_.end + (options_.end - options_.start) / 200;
    stepper_.accept(step_, check_motion, summary_.evidence);
    time_ = step_.end;
    control_.accept(step_, report_.error);
    ++summary_.accepted;
    summary_.smallest_step =
        summary_.accepted == 1 ? step_.size : std::min(summary_.smallest_step, step_.size);
    summary_.largest_step = std::max(summary_.largest_step, step_.size);
  }

  [[nodiscard]] std::string describe_step() const {
    std::ostringstream text;
    text << "step " << summary_.accepted + 1 << " at time " << time_ << " s of size " << step_.size
         << " s";
    return text.str();
  }

  bool fail(const std::string& reason) {
    const Status status =
        report_.status == Status::singular ? Status::singular : Status::not_converged;
    summary_.outcome = {status,
                        reason + ": " + describe_step() + ", " + stepper_.describe(report_)};
    return false;
  }

  Stepper& stepper_;
  Control control_;
  const TransientOptions& options_;
  TransientSummary summary_;
  Step step_;
  StepReport report_;  ///< report of the last attempt
  double time_, next_look_;
  std::int64_t max_steps_ = 0;
  const char* limit_reason_ = "the limit of the number of steps (max_steps) was reached";
};

}  // namespace

std::vector<double> even_times(double start, double end, double step) {
  std::vector<double> times;
  const auto count = static_cast<Index>(std::ceil((end - start) / step - 1e-9));
  for (Index i = 0; i < count; ++i) times.push_back(start + static_cast<double>(i) * step);
  times.push_back(end);
  return times;
}

TransientSummary integrate(Stepper& stepper, const TransientOptions& options,
                           const std::vector<double>& breakpoints, StepSizes sizes) {
  if (sizes == StepSizes::halved)
    return TimeIntegration<HalvedSteps>(stepper, options).run(make_stops(options, {}, breakpoints));
  return TimeIntegration<FreeSteps>(stepper, options)
      .run(make_stops(options, options.sample_times, breakpoints));
}

}  // namespace trammel::solver
