#include "harness/studies/cost.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/analysis/analysis.h"
#include "harness/base/statistic.h"
#include "harness/base/stopwatch.h"
#include "harness/studies/cost_study.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using results::CostSetting;
using results::ErrorNorms;

/// Returns the divisor that makes the error of an entry relative.
double divisor(double reference_solution, double largest, const Scale& scale) {
  if (scale.kind == Scale::Kind::number) return scale.number;
  const bool by_entry = scale.kind == Scale::Kind::entry && reference_solution != 0;
  return by_entry ? std::abs(reference_solution) : largest;
}

std::vector<double> relative_errors(const std::vector<double>& found,
                                    const std::vector<double>& reference_solution,
                                    const Scale& scale, double largest_of_all) {
  if (found.size() != reference_solution.size())
    throw std::runtime_error("expected " + std::to_string(reference_solution.size()) +
                             " values, as in the reference solution (got " +
                             std::to_string(found.size()) + ")");
  const double largest =
      scale.kind == Scale::Kind::largest ? largest_of_all : max_abs(reference_solution);
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double by = divisor(reference_solution[i], largest, scale);
    if (!(by > 0))
      throw std::runtime_error(
          "an error relative to zero is undefined; expected true values other than zero");
    errors.push_back((found[i] - reference_solution[i]) / by);
  }
  return errors;
}

/// Returns the values of the quantities that belong to one output of a cost study.
Observations values_of_output(const Observations& all,
                              const std::vector<ObservedQuantity>& observed, std::size_t output) {
  Observations values;
  for (std::size_t i = 0; i < observed.size(); ++i)
    if (observed[i].output == output) values.push_back(all.at(i));
  return values;
}

/// Returns the error norms of a setting for each output of a cost study.
std::vector<std::optional<ErrorNorms>> output_errors(const CostStudy& study, const Setting& setting,
                                                     const Observations& found,
                                                     const Observations& reference_solution) {
  std::vector<std::optional<ErrorNorms>> errors;
  for (std::size_t k = 0; k < study.outputs.size(); ++k) {
    const Observations values = values_of_output(found, setting.observed, k);
    Observations truth;
    if (study.reference_solution)
      truth = values_of_output(reference_solution, study.reference_solution->observed, k);
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
  return setting.document.error("", what + " cannot be computed: " + reason);
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

/// Returns the error and the status of a setting, determined by a single run without repeated
/// measurements of time.
CostSetting classify_run(const SandboxedRun& sandboxed, const Setting& setting,
                         const Observations& reference_solution, const CostStudy& study) {
  CostSetting measured;
  measured.curve = setting.curve;
  measured.curve_title = setting.curve_title;
  measured.title = setting.title;
  measured.value = setting.value;
  measured.reason = sandboxed.reason;
  measured.cpu_s = sandboxed.cpu_s;
  measured.counters = sandboxed.counters;
  measured.status =
      sandboxed.termination == SandboxedRun::Termination::timed_out ? "timed-out" : "failed";
  if (sandboxed.termination != SandboxedRun::Termination::solved) return measured;
  try {
    measured.output_errors = output_errors(study, setting, sandboxed.values, reference_solution);
    measured.errors = measured.output_errors.front();
  } catch (const std::runtime_error& error) {
    measured.reason = error.what();
    return measured;
  }
  const double error = *measured.errors->get(study.norm);
  if (!(error <= kDivergedError)) {
    measured.status = "diverged";
    measured.reason = std::isfinite(error) ? "the error exceeds 1000 %" : "error is not finite";
    return measured;
  }
  const bool is_reference = study.reference_solution &&
                            study.reference_solution->document.value() == setting.document.value();
  measured.status = is_reference ? "reference" : "measured";
  return measured;
}

bool is_computed(const CostSetting& setting) {
  return setting.is_measured() || setting.status == "reference";
}

/// @param output  index of the output; empty: the largest error of all outputs
std::optional<double> error_of_setting(const CostSetting& setting, const std::string& norm,
                                       std::optional<std::size_t> output) {
  const auto get = [&](const std::optional<ErrorNorms>& error) {
    return error ? std::optional(*error->get(norm)) : std::nullopt;
  };
  if (output) return get(*output == 0 ? setting.errors : setting.output_errors.at(*output));
  double largest = 0;
  for (const auto& error : setting.output_errors) {
    if (!error) return std::nullopt;
    largest = solver::nan_max(largest, *error->get(norm));
  }
  return largest;
}

void time_settings(const CostStudy& study, results::CostStudy& measured, const CostOptions& options,
                   const References& references, std::size_t& done, std::size_t all) {
  std::vector<CostSetting*> chosen;
  std::vector<std::function<void()>> works;
  for (std::size_t i = 0; i < measured.settings.size(); ++i) {
    if (!is_computed(measured.settings[i])) continue;
    chosen.push_back(&measured.settings[i]);
    works.emplace_back([&document = study.settings[i].document, &references] {
      (void)analyze(document, references, {false});
    });
  }
  const auto timings = measure_interleaved(works, options.timing, [&] {
    done += measured.settings.size();
    if (options.progress) options.progress(done, all);
  });
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    chosen[k]->time = {timings[k].cpu_s, 0, 0, timings[k].wall_median_s,
                       static_cast<std::size_t>(timings[k].runs_each)};
    chosen[k]->cpu_s = timings[k].median_s;
  }
}

std::vector<results::CheapestSetting> cheapest_settings(const std::vector<CostPoint>& points) {
  std::vector<results::CheapestSetting> all;
  for (const double error : target_errors_of_report()) {
    results::CheapestSetting& best = all.emplace_back();
    best.error = error;
    if (const auto point = fastest_allowed(points, error)) best.setting = point->setting;
    best.tied = tied_settings(points, error);
  }
  return all;
}

/// Returns the results of a cost study before its measurement: titles and descriptions without
/// settings.
results::CostStudy unmeasured_study(const CostStudy& study) {
  results::CostStudy out;
  out.id = study.id;
  out.family = study.family;
  out.title = study.title;
  out.description = study.description;
  out.reference_solution = study.reference_description;
  out.scale = study.outputs.front().scale_description;
  out.norm = study.norm;
  out.baseline = study.baseline;
  if (study.outputs.size() == 1) return out;
  for (const StudyOutput& output : study.outputs)
    out.outputs.push_back({output.title, output.scale_description, {}, {}});
  out.outputs.push_back({"all outputs together", "", {}, {}});
  return out;
}

}  // namespace

ErrorNorms error_norms(const Observations& computed, const Observations& reference_solution,
                       const Scale& scale) {
  double max = 0;
  std::size_t count = 0;
  double squares = 0, sum = 0, largest = 0;
  for (const std::vector<double>& values : reference_solution)
    largest = std::max(largest, max_abs(values));
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const std::vector<double> errors =
        reference_solution.at(i).empty()
            ? computed[i]
            : relative_errors(computed[i], reference_solution[i], scale, largest);
    for (const double error : errors) {
      const double size = std::abs(error);
      max = solver::nan_max(max, size);
      squares += size * size;
      sum += size;
      ++count;
    }
  }
  if (count == 0) throw std::runtime_error("the quantities that the study compares have no values");
  const auto n = static_cast<double>(count);
  return {max, std::sqrt(squares / n), sum / n};
}

std::vector<CostPoint> cost_points(const results::CostStudy& study,
                                   std::optional<std::size_t> output, std::size_t first_repeat,
                                   std::size_t stride) {
  const std::vector<double>& baseline = study.settings[study.baseline].time->cpu_s;
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < study.settings.size(); ++i) {
    const CostSetting& setting = study.settings[i];
    if (!setting.is_measured()) continue;
    const auto error = error_of_setting(setting, study.norm, output);
    if (!error || !(*error <= kDivergedError)) continue;
    const RelativeTime time = time_ratio(setting.time->cpu_s, baseline, first_repeat, stride);
    points.push_back({i, std::max(*error, kMinError), time.median, time.low, time.high});
  }
  return points;
}

results::CostStudy measure_study(const CostStudy& study, const CostOptions& options,
                                 const References& references) {
  const Stopwatch watch;
  results::CostStudy measured = unmeasured_study(study);
  const auto repeats = static_cast<std::size_t>(options.timing.repeats);
  const std::size_t all = study.settings.size() * (repeats + 1);
  std::size_t done = 0;
  const auto show = [&] {
    if (options.progress) options.progress(done, all);
  };
  const Observations reference_solution = compute_reference_solution(study, references, show);
  for (const Setting& setting : study.settings) {
    const SandboxedRun sandboxed = run_sandboxed(setting, study.time_limit_s, references, show);
    measured.settings.push_back(classify_run(sandboxed, setting, reference_solution, study));
    ++done;
    show();
  }
  const CostSetting& baseline = measured.settings[study.baseline];
  if (!is_computed(baseline))
    throw cannot(study.settings[study.baseline], "a baseline", baseline.reason);
  time_settings(study, measured, options, references, done, all);
  derive_time_ratios_and_front(measured);
  measured.references = references.hashes();
  measured.wall_s = watch.wall_s();
  return measured;
}

void derive_time_ratios_and_front(results::CostStudy& measured) {
  const CostSetting baseline = measured.settings[measured.baseline];
  std::vector<std::string> titles;
  for (CostSetting& setting : measured.settings) {
    titles.push_back(setting.title);
    setting.relative = setting.cpu_s / baseline.cpu_s;
    if (!setting.time) continue;
    const RelativeTime relative = time_ratio(setting.time->cpu_s, baseline.time->cpu_s);
    setting.relative = relative.median;
    setting.time->relative_low = relative.low;
    setting.time->relative_high = relative.high;
  }
  const std::vector<CostPoint> points = cost_points(measured), front = find_pareto_front(points);
  for (std::size_t i = 0; i < titles.size(); ++i)
    measured.settings[i].pareto_optimal = has_point_of_setting(front, i);
  measured.cheapest = cheapest_settings(points);
  for (std::size_t k = 0; k < measured.outputs.size(); ++k) {
    results::CostOutput& output = measured.outputs[k];
    const bool all_at_once = k + 1 == measured.outputs.size();
    const auto of_output = cost_points(measured, all_at_once ? std::nullopt : std::optional(k));
    output.errors.assign(titles.size(), {});
    for (const CostPoint& point : of_output) output.errors[point.setting] = point.error;
    output.cheapest = cheapest_settings(of_output);
  }
  measured.conclusion = describe_pareto_front(points, titles, measured.baseline);
  measured.repeatability =
      compare_pareto_fronts(cost_points(measured, 0, 0, 2), cost_points(measured, 0, 1, 2));
}

results::CostStudies cost_results(std::vector<results::CostStudy> studies, SweepExtent extent,
                                  const TimingOptions& timing) {
  return {extent == SweepExtent::quick ? "quick" : "full",
          timing.seed,
          static_cast<std::size_t>(timing.repeats),
          kParetoTolerance,
          kDivergedError,
          std::move(studies)};
}

}  // namespace trammel::harness
