#include "harness/studies/cost.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/analysis/analysis.h"
#include "harness/base/stopwatch.h"
#include "solver/model/numbers.h"

namespace trammel {
namespace {

using Standing = MeasuredSetting::Standing;

double largest_of(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// What the error of an entry is divided by.
double divisor(double truth, double largest, const Scale& scale) {
  if (scale.kind == Scale::Kind::number) return scale.number;
  if (scale.kind == Scale::Kind::largest || truth == 0) return largest;
  return std::abs(truth);
}

std::vector<double> relative_errors(const std::vector<double>& found,
                                    const std::vector<double>& truth, const Scale& scale,
                                    double largest_of_all) {
  if (found.size() != truth.size()) {
    throw std::runtime_error("expected " + std::to_string(truth.size()) +
                             " values, as the truth has (got " + std::to_string(found.size()) +
                             ")");
  }
  const double largest = scale.kind == Scale::Kind::largest ? largest_of_all : largest_of(truth);
  std::vector<double> errors;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double by = divisor(truth[i], largest, scale);
    if (!(by > 0)) throw std::runtime_error("expected true values other than zero");
    errors.push_back((found[i] - truth[i]) / by);
  }
  return errors;
}

Observations exact_values(const std::vector<Observed>& observed, const Observations& truth) {
  Observations all;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    if (observed[i].is_error) {
      all.emplace_back();
    } else {
      all.push_back(observed[i].exact.empty() ? truth.at(i) : observed[i].exact);
    }
  }
  return all;
}

InputError cannot(const Setting& setting, const std::string& what, const std::string& reason) {
  return setting.document.error("", "expected " + what + " that can be computed: " + reason);
}

Observations compute_truth(const CostStudy& study, const References& references) {
  if (!study.truth) return {};
  const Trial trial = try_setting(*study.truth, study.time_limit_s, references);
  if (trial.ending != Trial::Ending::solved) throw cannot(*study.truth, "a truth", trial.reason);
  return trial.values;
}

/// Everything but the time.
MeasuredSetting judge_trial(const Trial& trial, const Setting& setting, const Observations& truth,
                            const CostStudy& study) {
  MeasuredSetting measured;
  measured.reason = trial.reason;
  measured.cpu_s = trial.cpu_s;
  measured.counters = trial.counters;
  measured.standing =
      trial.ending == Trial::Ending::timed_out ? Standing::timed_out : Standing::failed;
  if (trial.ending != Trial::Ending::solved) return measured;
  try {
    measured.error = error_norms(trial.values, exact_values(setting.observed, truth), study.scale);
  } catch (const std::runtime_error& error) {
    measured.reason = error.what();
    return measured;
  }
  const double error = measured.error->get(study.norm);
  if (!(error <= diverged_above)) {
    measured.standing = Standing::diverged;
    measured.reason = std::isfinite(error) ? "the error is above 1000 %" : "not finite";
    return measured;
  }
  measured.standing = error == 0 && study.truth ? Standing::truth : Standing::measured;
  return measured;
}

bool is_computed(const MeasuredSetting& measured) {
  return measured.standing == Standing::measured || measured.standing == Standing::wide ||
         measured.standing == Standing::truth;
}

/// Median time of the repeats that begin at `first`, every `step`.
double median_of(const Timing& timing, std::size_t first, std::size_t step) {
  std::vector<double> chosen;
  for (std::size_t i = first; i < timing.cpu_s.size(); i += step) chosen.push_back(timing.cpu_s[i]);
  return quantile(chosen, 0.5);
}

std::vector<CostPoint> points_of(const MeasuredStudy& measured, std::size_t first,
                                 std::size_t step) {
  const Timing& baseline = *measured.settings[measured.study.baseline].timing;
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < measured.settings.size(); ++i) {
    const MeasuredSetting& one = measured.settings[i];
    if (one.standing != Standing::measured) continue;
    const double error = one.error->get(measured.study.norm);
    points.push_back({i, std::max(error, smallest_error),
                      median_of(*one.timing, first, step) / median_of(baseline, first, step)});
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

ErrorNorms error_norms(const Observations& found, const Observations& truth, const Scale& scale) {
  ErrorNorms norms;
  std::size_t count = 0;
  double squares = 0, sum = 0, largest = 0;
  for (const std::vector<double>& values : truth) largest = std::max(largest, largest_of(values));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::vector<double> errors =
        truth.at(i).empty() ? found[i] : relative_errors(found[i], truth[i], scale, largest);
    for (const double error : errors) {
      const double size = std::abs(error);
      norms.max = larger(norms.max, size);
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

MeasuredStudy measure(CostStudy study, const CostOptions& options, const References& references) {
  const Stopwatch watch;
  MeasuredStudy measured;
  measured.study = std::move(study);
  const CostStudy& its = measured.study;
  const auto repeats = static_cast<std::size_t>(options.timing.repeats);
  const std::size_t all = its.settings.size() * (repeats + 1);
  std::size_t done = 0;
  const Observations truth = compute_truth(its, references);
  for (const Setting& setting : its.settings) {
    const Trial trial = try_setting(setting, its.time_limit_s, references);
    measured.settings.push_back(judge_trial(trial, setting, truth, its));
    if (options.progress) options.progress(++done, all);
  }
  const MeasuredSetting& baseline = measured.settings[its.baseline];
  if (!is_computed(baseline)) {
    throw cannot(its.settings[its.baseline], "a baseline", baseline.reason);
  }
  time_settings(measured, options, references, done, all);
  conclude(measured);
  measured.wall_s = watch.wall_s();
  return measured;
}

void conclude(MeasuredStudy& measured) {
  const CostStudy& its = measured.study;
  for (MeasuredSetting& one : measured.settings) {
    one.relative = one.cpu_s / measured.settings[its.baseline].cpu_s;
    if (one.standing != Standing::measured && one.standing != Standing::wide) continue;
    one.standing = one.timing->spread() > widest_spread ? Standing::wide : Standing::measured;
  }
  measured.points = points_of(measured, 0, 1);
  measured.front = efficient_front(measured.points);
  measured.words = front_in_words(measured.points, titles_of(its), its.baseline);
  measured.repeatability = compare_fronts(points_of(measured, 0, 2), points_of(measured, 1, 2));
}

const char* to_string(Standing standing) {
  switch (standing) {
    case Standing::measured:
      return "measured";
    case Standing::wide:
      return "wide";
    case Standing::truth:
      return "truth";
    case Standing::diverged:
      return "diverged";
    case Standing::timed_out:
      return "timed-out";
    case Standing::failed:
      return "failed";
  }
  return "";
}

}  // namespace trammel
