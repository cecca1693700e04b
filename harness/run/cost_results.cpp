#include "harness/run/cost_results.h"

#include <algorithm>

#include "harness/run/results.h"

namespace trammel::harness {
namespace {

results::SettingTime setting_time(const Timing& timing, const RelativeTime& relative) {
  return {timing.cpu_s, relative.low, relative.high, timing.wall_median_s,
          static_cast<std::size_t>(timing.runs_each)};
}

results::CostSetting setting_results(const Setting& setting, const MeasuredSetting& measured,
                                     bool pareto_optimal) {
  results::CostSetting out;
  out.curve = setting.curve;
  out.curve_title = setting.curve_title;
  out.title = setting.title;
  out.value = setting.value;
  out.status = to_string(measured.status);
  out.reason = measured.reason;
  if (const auto& error = measured.error) out.errors = {{error->max}, {error->rms}, {error->mean}};
  out.cpu_s = measured.cpu_s;
  out.relative = measured.relative.median;
  if (measured.timing) out.time = setting_time(*measured.timing, measured.relative);
  out.counters = counters(measured.counters);
  out.pareto_optimal = pareto_optimal;
  return out;
}

std::vector<results::CheapestSetting> cheapest_settings(const std::vector<CostPoint>& points) {
  std::vector<results::CheapestSetting> all;
  for (const double error : target_errors()) {
    results::CheapestSetting& at = all.emplace_back();
    at.error = error;
    if (const auto found = cheapest(points, error)) at.setting = found->setting;
    at.tied = tied_settings(points, error);
  }
  return all;
}

/// @param output  none: all of them at once
results::CostOutput output_results(const MeasuredStudy& measured,
                                   std::optional<std::size_t> output) {
  const std::vector<StudyOutput>& outputs = measured.study.outputs;
  results::CostOutput out;
  out.title = output ? outputs[*output].title : "all at once";
  if (output) out.scale = outputs[*output].scale_description;
  out.errors.resize(measured.settings.size());
  const std::vector<CostPoint> points = output_points(measured, output);
  for (const CostPoint& point : points) out.errors[point.setting] = point.error;
  out.cheapest = cheapest_settings(points);
  return out;
}

}  // namespace

results::CostStudy study_results(const MeasuredStudy& measured) {
  const CostStudy& study = measured.study;
  results::CostStudy out;
  out.id = study.id;
  out.family = study.family;
  out.title = study.title;
  out.description = study.description;
  out.reference_solution = study.reference_description;
  out.scale = study.outputs.front().scale_description;
  out.norm = to_string(study.norm);
  out.baseline = study.baseline;
  out.wall_s = measured.wall_s;
  for (std::size_t i = 0; i < study.settings.size(); ++i) {
    out.settings.push_back(setting_results(study.settings[i], measured.settings[i],
                                           has_setting(measured.pareto_front, i)));
  }
  out.cheapest = cheapest_settings(measured.points);
  if (study.outputs.size() > 1) {
    for (std::size_t k = 0; k < study.outputs.size(); ++k)
      out.outputs.push_back(output_results(measured, k));
    out.outputs.push_back(output_results(measured, std::nullopt));
  }
  const ParetoFrontAgreement& agreement = measured.repeatability;
  out.repeatability = {agreement.shared,
                       agreement.either,
                       agreement.same_cheapest,
                       agreement.targets,
                       agreement.median_difference,
                       agreement.largest_difference};
  out.conclusion = measured.conclusion;
  return out;
}

results::CostStudies cost_results(const std::vector<MeasuredStudy>& studies, SweepExtent extent,
                                  const TimingOptions& timing) {
  results::CostStudies out{extent == SweepExtent::quick ? "quick" : "full",
                           timing.seed,
                           static_cast<std::size_t>(timing.repeats),
                           kParetoTolerance,
                           kDivergedError,
                           {}};
  for (const MeasuredStudy& study : studies) out.studies.push_back(study_results(study));
  return out;
}

std::vector<CostPoint> cost_points(const results::CostStudy& study) {
  std::vector<CostPoint> points;
  for (std::size_t i = 0; i < study.settings.size(); ++i) {
    const results::CostSetting& setting = study.settings[i];
    if (!setting.measured()) continue;
    points.push_back({i, std::max(study.error(setting).value(), kMinError),
                      setting.relative.value(), setting.time->relative_low,
                      setting.time->relative_high});
  }
  return points;
}

}  // namespace trammel::harness
