#include "harness/run/cost_results.h"

#include <algorithm>
#include <cmath>

namespace trammel::harness {
namespace {

Json error_json(const std::optional<ErrorNorms>& error) {
  if (!error) return nullptr;
  return {{"max", number_or_null(error->max)},
          {"rms", number_or_null(error->rms)},
          {"mean", number_or_null(error->mean)}};
}

Json time_json(const std::optional<Timing>& timing) {
  if (!timing) return nullptr;
  return {{"cpu_s", timing->cpu_s},
          {"lower_quartile_s", timing->lower_quartile_s},
          {"upper_quartile_s", timing->upper_quartile_s},
          {"spread", timing->spread()},
          {"wall_median_s", timing->wall_median_s},
          {"runs_each", timing->runs_each}};
}

Json setting_json(const Setting& setting, const MeasuredSetting& measured, bool on_pareto_front) {
  return {{"curve", setting.curve},
          {"curve_title", setting.curve_title},
          {"title", setting.title},
          {"value", setting.value ? number_or_null(*setting.value) : Json(nullptr)},
          {"standing", to_string(measured.status)},
          {"reason", measured.reason},
          {"error", error_json(measured.error)},
          {"cpu_s", measured.cpu_s},
          {"relative_time", number_or_null(measured.relative)},
          {"time", time_json(measured.timing)},
          {"counters",
           {{"element_evaluations", measured.counters.element_evaluations},
            {"factorizations", measured.counters.factorizations},
            {"solves", measured.counters.solves},
            {"steps", measured.counters.steps}}},
          {"on_front", on_pareto_front}};
}

Json agreement_json(const ParetoFrontAgreement& agreement) {
  return {{"shared", agreement.shared},
          {"either", agreement.either},
          {"same_cheapest", agreement.same_cheapest},
          {"asked", agreement.targets},
          {"median_difference", agreement.median_difference},
          {"largest_difference", agreement.largest_difference}};
}

Json study_json(const MeasuredStudy& measured) {
  const CostStudy& study = measured.study;
  Json json = {{"id", study.id}, {"family", study.family}, {"title", study.title}};
  if (!study.description.empty()) json["description"] = study.description;
  json["truth"] = study.reference_description;
  json["scale"] = study.scale_description;
  json["norm"] = to_string(study.norm);
  json["baseline"] = study.baseline;
  json["wall_s"] = measured.wall_s;
  json["settings"] = Json::array();
  for (std::size_t i = 0; i < study.settings.size(); ++i) {
    const bool on_pareto_front =
        std::any_of(measured.pareto_front.begin(), measured.pareto_front.end(),
                    [i](const CostPoint& point) { return point.setting == i; });
    json["settings"].push_back(
        setting_json(study.settings[i], measured.settings[i], on_pareto_front));
  }
  json["cheapest"] = Json::array();
  for (const double error : target_errors()) {
    const auto found = cheapest(measured.points, error);
    json["cheapest"].push_back(
        {{"error", error}, {"setting", found ? Json(found->setting) : Json(nullptr)}});
  }
  json["repeatability"] = agreement_json(measured.repeatability);
  json["words"] = measured.conclusion;
  return json;
}

}  // namespace

Json cost_json(const std::vector<MeasuredStudy>& studies, SweepExtent extent,
               const TimingOptions& timing) {
  Json json = {{"sweep", extent == SweepExtent::quick ? "quick" : "full"},
               {"seed", timing.seed},
               {"repeats", timing.repeats},
               {"widest_spread", kMaxSpread},
               {"equal_within", kParetoTolerance},
               {"diverged_above", kDivergedError},
               {"studies", Json::array()}};
  for (const MeasuredStudy& study : studies) json["studies"].push_back(study_json(study));
  return json;
}

std::vector<CostPoint> cost_points(const Json& study) {
  std::vector<CostPoint> points;
  const auto norm = study.at("norm").get<std::string>();
  for (std::size_t i = 0; i < study.at("settings").size(); ++i) {
    const Json& setting = study.at("settings").at(i);
    if (setting.at("standing") != "measured") continue;
    points.push_back({i, std::max(setting.at("error").at(norm).get<double>(), kMinError),
                      setting.at("relative_time").get<double>()});
  }
  return points;
}

}  // namespace trammel::harness
