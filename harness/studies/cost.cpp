#include "harness/studies/cost.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "harness/analysis/analysis.h"
#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using MeasurementStatus = MeasuredSetting::MeasurementStatus;

/// What the error of an entry is divided by.
double divisor(double reference_solution, double largest, const Scale& scale) {
  if (scale.kind == Scale::Kind::number) return scale.number;
  const bool by_entry = scale.kind == Scale::Kind::entry && reference_solution != 0;
  return by_entry ? std::abs(reference_solution) : largest;
}

std::vector<double> relative_errors(const std::vector<double>& found,
                                    const std::vector<double>& reference_solution,
                                    const Scale& scale, double largest_of_all) {
  if (found.size() != reference_solution.size()) {
    throw std::runtime_error("expected " + std::to_string(reference_solution.size()) +
                             " values, as the reference solution has (got " +
                             std::to_string(found.size()) + ")");
  }
  const double largest =
      scale.kind == Scale::Kind::largest ? largest_of_all : max_abs(reference_solution);
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double by = divisor(reference_solution[i], largest, scale);
    if (!(by > 0)) throw std::runtime_error("expected true values other than zero");
    errors.push_back((found[i] - reference_solution[i]) / by);
  }
  return errors;
}

/// What belongs to one output.
Observations values_of(const Observations& all, const std::vector<ObservedQuantity>& observed,
                       std::size_t output) {
  Observations values;
  for (std::size_t i = 0; i < observed.size(); ++i)
    if (observed[i].output == output) values.push_back(all.at(i));
  return values;
}

/// The errors of a setting by output.
std::vector<std::optional<ErrorNorms>> output_errors(const CostStudy& study, const Setting& setting,
                                                     const Observations& found,
                                                     const Observations& reference_solution) {
  std::vector<std::optional<ErrorNorms>> errors;
  for (std::size_t k = 0; k < study.outputs.size(); ++k) {
    const Observations values = values_of(found, setting.observed, k);
    Observations truth;
    if (study.reference_solution)
      truth = values_of(reference_solution, study.reference_solution->observed, k);
    std::size_t i = 0;
    for (const ObservedQuantity& one : setting.observed) {
      if (one.output != k) continue;
      truth.resize(std::max(truth.size(), i + 1));
      if (!one.exact.empty()) truth[i] = one.exact;
      if (one.is_error) truth[i].clear();
      ++i;
    }
    errors.emplace_back();
    if (!values.empty()) errors.back() = error_norms(values, truth, study.outputs[k].scale);
  }
  return errors;
}

InputError cannot(const Setting& setting, const std::string& what, const std::string& reason) {
  return setting.document.error("", "expected " + what + " that can be computed: " + reason);
}

Observations compute_reference_solution(const CostStudy& study, const References& references,
                                        const std::function<void()>& waiting) {
  if (!study.reference_solution) return {};
  const SandboxedRun sandboxed =
      run_sandboxed(*study.reference_solution, study.time_limit_s, references, waiting);
  if (sandboxed.termination != SandboxedRun::Termination::solved)
    throw cannot(*study.reference_solution, "a reference solution", sandboxed.reason);
  return sandboxed.values;
}

/// Everything but the time.
MeasuredSetting classify_run(const SandboxedRun& sandboxed, const Setting& setting,
                             const Observations& reference_solution, const CostStudy& study) {
  MeasuredSetting measured;
  measured.reason = sandboxed.reason;
  measured.cpu_s = sandboxed.cpu_s;
  measured.counters = sandboxed.counters;
  measured.status = sandboxed.termination == SandboxedRun::Termination::timed_out
                        ? MeasurementStatus::timed_out
                        : MeasurementStatus::failed;
  if (sandboxed.termination != SandboxedRun::Termination::solved) return measured;
  try {
    measured.output_errors = output_errors(study, setting, sandboxed.values, reference_solution);
    measured.error = measured.output_errors.front();
  } catch (const std::runtime_error& error) {
    measured.reason = error.what();
    return measured;
  }
  const double error = measured.error->get(study.norm);
  if (!(error <= kDivergedError)) {
    measured.status = MeasurementStatus::diverged;
    measured.reason = std::isfinite(error) ? "the error is above 1000 %" : "not finite";
    return measured;
  }
  const bool is_reference = study.reference_solution &&
                            study.reference_solution->document.value() == setting.document.value();
  measured.status =
      is_reference ? MeasurementStatus::reference_solution : MeasurementStatus::measured;
  return measured;
}

bool is_computed(const MeasuredSetting& measured) {
  return measured.status == MeasurementStatus::measured ||
         measured.status == MeasurementStatus::reference_solution;
}

/// @param output  none: the largest error of all outputs
std::optional<double> error_of(const MeasuredSetting& measurement, Norm norm,
                               std::optional<std::size_t> output) {
  const auto get = [&](const std::optional<ErrorNorms>& error) {
    return error ? std::optional(error->get(norm)) : std::nullopt;
  };
  if (output) return get(measurement.output_errors.at(*output));
  std::optional<double> largest = 0;
  for (const auto& error : measurement.output_errors) {
    if (!error) return std::nullopt;
    largest = solver::nan_max(*largest, error->get(norm));
  }
  return largest;
}

std::vector<CostPoint> points_of(const MeasuredStudy& measured, std::optional<std::size_t> output,
                                 std::size_t first, std::size_t step) {
  const Timing& baseline = *measured.settings[measured.study.baseline].timing;
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < measured.settings.size(); ++i) {
    const MeasuredSetting& measurement = measured.settings[i];
    if (measurement.status != MeasurementStatus::measured) continue;
    const auto error = error_of(measurement, measured.study.norm, output);
    if (!error || !(*error <= kDivergedError)) continue;
    const RelativeTime time = relative_time(*measurement.timing, baseline, first, step);
    points.push_back({i, std::max(*error, kMinError), time.median, time.low, time.high});
  }
  return points;
}

void time_settings(MeasuredStudy& measured, const CostOptions& options,
                   const References& references, std::size_t& done, std::size_t all) {
  std::vector<std::size_t> chosen;
  std::vector<std::function<void()>> works;
  for (std::size_t i = 0; i < measured.settings.size(); ++i) {
    if (!is_computed(measured.settings[i])) continue;
    chosen.push_back(i);
    works.emplace_back([&document = measured.study.settings[i].document, &references] {
      (void)analyse(document, references, {false});
    });
  }
  const std::size_t each = measured.settings.size();
  const auto timings = time_interleaved(works, options.timing, [&] {
    done += each;
    if (options.progress) options.progress(done, all);
  });
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    measured.settings[chosen[k]].timing = timings[k];
    measured.settings[chosen[k]].cpu_s = timings[k].median_s;
  }
}

std::vector<std::string> titles_of(const CostStudy& study) {
  std::vector<std::string> titles;
  for (const Setting& setting : study.settings) titles.push_back(setting.title);
  return titles;
}

}  // namespace

double ErrorNorms::get(Norm norm) const {
  return norm == Norm::max ? max : norm == Norm::rms ? rms : mean;
}

ErrorNorms error_norms(const Observations& found, const Observations& reference_solution,
                       const Scale& scale) {
  ErrorNorms norms;
  std::size_t count = 0;
  double squares = 0, sum = 0, largest = 0;
  for (const std::vector<double>& values : reference_solution)
    largest = std::max(largest, max_abs(values));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::vector<double> errors =
        reference_solution.at(i).empty()
            ? found[i]
            : relative_errors(found[i], reference_solution[i], scale, largest);
    for (const double error : errors) {
      const double size = std::abs(error);
      norms.max = solver::nan_max(norms.max, size);
      squares += size * size;
      sum += size;
      ++count;
    }
  }
  if (count == 0) throw std::runtime_error("expected at least one value");
  norms.rms = std::sqrt(squares / static_cast<double>(count));
  norms.mean = sum / static_cast<double>(count);
  return norms;
}

std::vector<CostPoint> output_points(const MeasuredStudy& measured,
                                     std::optional<std::size_t> output) {
  return points_of(measured, output, 0, 1);
}

MeasuredStudy measure(CostStudy study, const CostOptions& options, const References& references) {
  const Stopwatch watch;
  MeasuredStudy measured;
  measured.study = std::move(study);
  const CostStudy& cost_study = measured.study;
  const auto repeats = static_cast<std::size_t>(options.timing.repeats);
  const std::size_t all = cost_study.settings.size() * (repeats + 1);
  std::size_t done = 0;
  const auto show = [&] {
    if (options.progress) options.progress(done, all);
  };
  const Observations reference_solution = compute_reference_solution(cost_study, references, show);
  for (const Setting& setting : cost_study.settings) {
    const SandboxedRun sandboxed =
        run_sandboxed(setting, cost_study.time_limit_s, references, show);
    measured.settings.push_back(classify_run(sandboxed, setting, reference_solution, cost_study));
    ++done;
    show();
  }
  const MeasuredSetting& baseline = measured.settings[cost_study.baseline];
  if (!is_computed(baseline)) {
    throw cannot(cost_study.settings[cost_study.baseline], "a baseline", baseline.reason);
  }
  time_settings(measured, options, references, done, all);
  derive_results(measured);
  measured.wall_s = watch.wall_s();
  return measured;
}

void derive_results(MeasuredStudy& measured) {
  const CostStudy& cost_study = measured.study;
  const MeasuredSetting& baseline = measured.settings[cost_study.baseline];
  for (MeasuredSetting& measurement : measured.settings) {
    const double trial = measurement.cpu_s / baseline.cpu_s;
    measurement.relative = measurement.timing ? relative_time(*measurement.timing, *baseline.timing)
                                              : RelativeTime{trial, trial, trial};
  }
  measured.points = output_points(measured, 0);
  measured.pareto_front = find_pareto_front(measured.points);
  measured.conclusion =
      describe_pareto_front(measured.points, titles_of(cost_study), cost_study.baseline);
  measured.repeatability =
      compare_pareto_fronts(points_of(measured, 0, 0, 2), points_of(measured, 0, 1, 2));
}

const char* to_string(MeasurementStatus status) {
  constexpr std::array names = {"measured", "reference", "diverged", "timed-out", "failed"};
  return names[static_cast<std::size_t>(status)];
}

}  // namespace trammel::harness
