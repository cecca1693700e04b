#include "solver/time/integrate.h"

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

/// Sample times, breakpoints after the start and the end, in ascending order.
std::vector<Stop> stops_of(const TransientOptions& options, const std::vector<double>& samples,
                           const std::vector<double>& breakpoints) {
  // Round-off error of a time that is a multiple of a step: breakpoints that are farther apart are
  // integrated one by one, however short a pulse is.
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

/// Chooses the sizes of steps from stop to stop.
class StepControl {
 public:
  explicit StepControl(const TransientOptions& options) : options_(options) {}
  StepControl(const StepControl&) = delete;
  StepControl& operator=(const StepControl&) = delete;
  StepControl(StepControl&&) = delete;
  StepControl& operator=(StepControl&&) = delete;
  virtual ~StepControl() = default;
  virtual void begin(double time, double stop) = 0;
  [[nodiscard]] virtual Step next(double time) const = 0;
  virtual void accept(const Step& step, double error) = 0;
  /// @returns null, or the reason for giving up
  [[nodiscard]] virtual const char* reject(const Step& step, const StepReport& report) = 0;
  /// Steps with at most this share of the allowed error are accepted.
  [[nodiscard]] virtual double error_limit() const { return 1; }

 protected:
  /// @returns number of equal steps up to a stop that are not above the requested one
  [[nodiscard]] double equal_steps(double span, int multiple) const {
    return multiple * std::max(1.0, std::ceil(span / (multiple * options_.step) * (1 - 1e-9)));
  }
  const TransientOptions& options_;
};

class HalvedSteps final : public StepControl {
 public:
  using StepControl::StepControl;
  void begin(double time, double stop) override {
    begin_ = time;
    end_ = stop;
    const double steps = std::min(1e12, equal_steps(stop - time, 1));
    const double largest = (stop - time) / steps;
    if (!(std::abs(largest - largest_) <= 1e-12 * largest_)) largest_ = largest;
    done_ = 0;
    count_ = static_cast<std::int64_t>(steps) << level_;
  }
  [[nodiscard]] Step next(double /*time*/) const override {
    const double h = std::ldexp(largest_, -level_);
    const bool last = done_ + 1 == count_;
    return {h, last ? end_ : begin_ + static_cast<double>(done_ + 1) * h, level_, last};
  }
  void accept(const Step& /*step*/, double error) override {
    ++done_;
    if (level_ == 0 || error >= 0.125 || done_ % 2 != 0) return;
    --level_;
    done_ /= 2;
    count_ /= 2;
  }
  [[nodiscard]] const char* reject(const Step& /*step*/, const StepReport& report) override {
    if (report.status != Status::solved) return "the step fails";
    if (++level_ > options_.adaptive->finest_level) return "the step is the smallest";
    done_ *= 2;
    count_ *= 2;
    return nullptr;
  }

 private:
  double begin_ = 0, end_ = 0, largest_ = 0;
  std::int64_t done_ = 0, count_ = 0;  ///< steps of the present level
  int level_ = 0;
};

class FreeSteps final : public StepControl {
 public:
  explicit FreeSteps(const TransientOptions& options) : StepControl(options), size_(options.step) {}
  void begin(double time, double stop) override {
    stop_ = stop;
    longest_ = options_.adaptive
                   ? std::numeric_limits<double>::infinity()
                   : (stop - time) / equal_steps(stop - time, options_.steps_in_multiples_of);
    failures_ = 0;
    failed_size_ = 0;
  }
  /// Equal steps up to a sample: no tiny last one.
  [[nodiscard]] Step next(double time) const override {
    const double remaining = stop_ - time;
    const double allowed = failures_ > 0 ? size_ : std::min(size_, longest_);
    const double count = std::ceil(remaining / allowed * (1 - 1e-9));
    if (count <= 1) return {remaining, stop_, 0, true};
    const bool every_step_is_shown = options_.adaptive && options_.sample_times.empty();
    const double size = every_step_is_shown ? allowed : remaining / count;
    return {size, time + size, 0, false};
  }
  void accept(const Step& step, double error) override {
    failures_ = 0;
    failed_size_ = 0;
    if (!options_.adaptive) {
      size_ = std::min(options_.step, 2 * size_);
      return;
    }
    // What a stop cut short does not shrink the next step.
    const double wanted = step.size * 0.85 / std::cbrt(std::max(error, 1e-6));
    size_ = std::clamp(wanted, 0.3 * step.size, std::max(1.8 * step.size, size_));
  }
  [[nodiscard]] const char* reject(const Step& step, const StepReport& report) override {
    if (++failures_ > 30) return "no step converges";
    if (report.status != Status::solved) {
      size_ = retry(step.size);
    } else if (report.leaves_branch) {
      size_ = step.size / 2;
    } else {
      size_ = step.size * std::clamp(0.85 / std::cbrt(report.error), 0.2, 0.8);
    }
    if (size_ >= 1e-7 * options_.step || step.last) return nullptr;
    return "the step has become smaller than 1e-7 of the requested one";
  }
  [[nodiscard]] double error_limit() const override { return 1.5; }

 private:
  /// After a step that does not converge: a smaller one, and every second time a larger one, since
  /// a singular position may lie within the step and beyond it the equations are regular again.
  double retry(double size) {
    if (failed_size_ == 0) failed_size_ = size;
    const double smaller = failed_size_ * std::pow(0.5, (failures_ + 1) / 2);
    const double larger = failed_size_ * (1 + 0.3 * failures_ / (1 + 0.1 * failures_));
    return failures_ % 2 == 1 ? smaller : larger;
  }

  double stop_ = 0, longest_ = 0;
  double size_ = 0, failed_size_ = 0;
  int failures_ = 0;
};

class TimeIntegration {
 public:
  TimeIntegration(Stepper& stepper, StepControl& control, const TransientOptions& options)
      : stepper_(stepper), control_(control), options_(options), next_look_(options.start) {}

  TransientSummary run(const std::vector<Stop>& stops) {
    set_step_limit(std::ssize(stops));
    stepper_.show();
    for (const Stop& stop : stops) {
      if (!advance(stop.time)) break;
      if (stop.breakpoint) stepper_.restart();
      if (stop.sample && stop.time > options_.start) stepper_.show();
    }
    summary_.time = stepper_.time();
    summary_.counters.steps = summary_.accepted + summary_.rejected;
    return std::move(summary_);
  }

 private:
  /// With fixed steps, at most ten times as many as asked for (and 1000): steps that keep failing
  /// are made ever smaller, and the run must end.
  void set_step_limit(Index stops) {
    max_steps_ = options_.max_steps;
    if (options_.adaptive) return;
    const double steps = (options_.end - options_.start) / options_.step +
                         static_cast<double>(options_.steps_in_multiples_of * stops);
    const double limit = 1000 + 10 * steps;
    if (limit >= static_cast<double>(max_steps_)) return;
    max_steps_ = static_cast<std::int64_t>(limit);
    limit_reason_ = "steps keep failing, ten times as many as asked for are spent";
  }

  bool advance(double stop) {
    if (!(stepper_.time() < stop)) return true;
    control_.begin(stepper_.time(), stop);
    step_ = control_.next(stepper_.time());
    summary_.outcome = stepper_.begin(step_, stop);
    if (!summary_.outcome.solved()) {
      summary_.outcome.reason += " at " + describe_step();
      return false;
    }
    while (stepper_.time() < stop) {
      if (summary_.accepted + summary_.rejected >= max_steps_) return fail(limit_reason_);
      step_ = control_.next(stepper_.time());
      report_ = stepper_.attempt(step_);
      summary_.iterations += report_.iterations;
      if (report_.status != Status::solved || report_.error > control_.error_limit() ||
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
    const bool inspect = step_.end >= next_look_ || step_.end >= options_.end;
    if (inspect) next_look_ = step_.end + (options_.end - options_.start) / 200;
    stepper_.accept(step_, inspect, summary_.evidence);
    control_.accept(step_, report_.error);
    ++summary_.accepted;
    summary_.smallest_step =
        summary_.accepted == 1 ? step_.size : std::min(summary_.smallest_step, step_.size);
    summary_.largest_step = std::max(summary_.largest_step, step_.size);
  }

  [[nodiscard]] std::string describe_step() const {
    std::ostringstream text;
    text << "step " << summary_.accepted + 1 << " at time " << stepper_.time() << " s of size "
         << step_.size << " s";
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
  StepControl& control_;
  const TransientOptions& options_;
  TransientSummary summary_;
  Step step_;
  StepReport report_;  ///< the last one
  double next_look_ = 0;
  std::int64_t max_steps_ = 0;
  const char* limit_reason_ = "too many steps";
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
  const auto run = [&](StepControl& control, const std::vector<double>& samples) {
    return TimeIntegration(stepper, control, options).run(stops_of(options, samples, breakpoints));
  };
  HalvedSteps halved(options);
  FreeSteps free(options);
  return sizes == StepSizes::halved ? run(halved, {}) : run(free, options.sample_times);
}

}  // namespace trammel::solver
