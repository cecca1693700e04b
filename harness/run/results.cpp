#include "harness/run/results.h"

#include <cmath>
#include <fstream>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

Json numbers(const std::vector<double>& values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(number_or_null(value));
  return array;
}

Json points(const std::vector<Eigen::Vector2d>& all) {
  Json array = Json::array();
  for (const Eigen::Vector2d& point : all)
    array.push_back({number_or_null(point.x()), number_or_null(point.y())});
  return array;
}

Json tolerance(const CheckResult& check_result) {
  if (!check_result.window) return nullptr;
  if (check_result.symmetric) return number_or_null(check_result.window->high);
  return {number_or_null(check_result.window->low), number_or_null(check_result.window->high)};
}

Json check_result_json(const CheckResult& check_result) {
  Json json = {{"name", check_result.name}};
  if (!check_result.title.empty()) json["title"] = check_result.title;
  json["quantity"] = check_result.quantity;
  json["index"] = check_result.index ? Json(*check_result.index) : Json(nullptr);
  if (!check_result.statistic.empty()) json["statistic"] = check_result.statistic;
  json["computed"] = number_or_null(check_result.computed);
  json["expected"] = number_or_null(check_result.expected);
  json["unit"] = check_result.unit;
  if (!check_result.reference.empty()) json["reference"] = check_result.reference;
  if (!check_result.against_variant.empty()) json["against_variant"] = check_result.against_variant;
  if (!check_result.against_quantity.empty())
    json["against_quantity"] = check_result.against_quantity;
  json["role"] = to_string(check_result.role);
  json["measure"] = check_result.measure;
  json["difference"] = number_or_null(check_result.difference);
  json["tolerance"] = tolerance(check_result);
  json["why"] = check_result.why;
  json["expectation"] = to_string(check_result.expectation);
  json["verdict"] = to_string(check_result.verdict);
  json["message"] = check_result.message;
  return json;
}

Json convergence(const Convergence& found) {
  const Series& series = found.series;
  Json json = {{"sweep", series.sweep},
               {"parameter", numbers(series.parameter)},
               {"quantity", series.quantity},
               {"index", series.index}};
  if (!series.statistic.empty()) json["statistic"] = series.statistic;
  json["values"] = numbers(series.values);
  if (!series.reference.empty()) json["reference"] = series.reference;
  json["exact"] = number_or_null(series.exact);
  json["error"] = numbers(found.error);
  json["roundoff"] = numbers(series.roundoff);
  json["order"] = numbers(found.order);
  json["in_asymptotic_range"] = found.in_asymptotic_range;
  json["at_roundoff_floor"] = found.at_roundoff_floor;
  json["theory_order"] = number_or_null(series.theory);
  if (series.lower) json["lower_order"] = number_or_null(series.lower);
  if (found.two_term) {
    json["two_term"] = {{"coefficients",
                         {number_or_null(found.two_term->coefficient[0]),
                          number_or_null(found.two_term->coefficient[1])}},
                        {"worst", number_or_null(found.two_term->worst)},
                        {"used", found.two_term->used}};
  }
  json["fitted_order"] = number_or_null(found.fitted_order);
  json["richardson"] = number_or_null(found.richardson);
  json["band"] = numbers(found.gci);
  json["factor"] = numbers(found.factor);
  return json;
}

Json interval(const Validation& validation) {
  return {number_or_null(validation.low), number_or_null(validation.high)};
}

Json comparison(const ComparedEntry& entry, const std::vector<StatedInput>& inputs) {
  Json json = {{"check", entry.check},
               {"quantity", entry.quantity},
               {"index", entry.index},
               {"unit", entry.unit},
               {"reference", entry.reference},
               {"simulation", number_or_null(entry.comparison.simulation)},
               {"expected", number_or_null(entry.comparison.reference)},
               {"u_num", number_or_null(entry.comparison.u_num)},
               {"u_input", number_or_null(entry.comparison.u_input)},
               {"u_input_sampled", number_or_null(entry.u_input_sampled)},
               {"u_reference", number_or_null(entry.comparison.u_reference)},
               {"contributions", Json::object()}};
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    json["contributions"][inputs[k].name] = number_or_null(entry.contribution[k]);
  }
  json["dominant_input"] = entry.dominant;
  json["dominant_share"] = number_or_null(entry.dominant_share);
  json["spread"] = numbers(entry.spread);
  json["difference"] = number_or_null(entry.validation.difference);
  json["u_val"] = number_or_null(entry.validation.u_val);
  json["interval"] = interval(entry.validation);
  json["verdict"] = to_string(entry.validation.verdict);
  json["words"] = entry.validation.text;
  json["literal"] = {{"u_input", number_or_null(entry.literal_comparison.u_input)},
                     {"u_input_sampled", number_or_null(entry.u_input_literal_sampled)},
                     {"u_val", number_or_null(entry.literal.u_val)},
                     {"interval", interval(entry.literal)},
                     {"verdict", to_string(entry.literal.verdict)},
                     {"words", entry.literal.text}};
  return json;
}

Json uncertainty(const ValidationUncertainty& found) {
  Json json = {{"inputs", Json::array()},
               {"samples", found.samples},
               {"failed", found.failed},
               {"literal_samples", found.literal_samples},
               {"literal_failed", found.literal_failed},
               {"numerical", Json::array()},
               {"comparisons", Json::array()}};
  for (const StatedInput& input : found.inputs) {
    json["inputs"].push_back({{"name", input.name},
                              {"pointers", input.pointers},
                              {"half_width", number_or_null(input.half_width)},
                              {"nominal", input.nominal},
                              {"why", input.why}});
  }
  for (const NumericalEstimate& estimate : found.numerical) {
    json["numerical"].push_back({{"refinement", estimate.refinement},
                                 {"quantity", estimate.quantity},
                                 {"index", estimate.index},
                                 {"parameter", numbers(estimate.parameter)},
                                 {"values", numbers(estimate.values)},
                                 {"order", number_or_null(estimate.order)},
                                 {"factor", number_or_null(estimate.factor)},
                                 {"half_width", number_or_null(estimate.half_width)}});
  }
  for (const ComparedEntry& entry : found.entries) {
    json["comparisons"].push_back(comparison(entry, found.inputs));
  }
  return json;
}

Json drawing_json(const Drawing& drawn) {
  Json json = {{"nodes_m", points(drawn.nodes)},
               {"members", drawn.members},
               {"triangles", drawn.triangles},
               {"joints", Json::array()},
               {"shapes", Json::array()}};
  for (const Drawing::Joint& joint : drawn.joints) {
    json["joints"].push_back({{"node", joint.node}, {"kind", joint.kind}, {"name", joint.name}});
  }
  for (const Drawing::Shape& shape : drawn.shapes) {
    json["shapes"].push_back(
        {{"label", shape.label}, {"displacement_m", points(shape.displacement)}});
  }
  if (drawn.poses.empty()) return json;
  json["poses"] = Json::array();
  for (const Drawing::Pose& pose : drawn.poses) {
    json["poses"].push_back({{"label", pose.label}, {"nodes_m", points(pose.nodes)}});
  }
  return json;
}

Json cost(const Run& run) {
  const solver::Counters& counters = run.result.counters;
  Json json = {{"wall_s", run.wall_s},
               {"cpu_s", run.cpu_s},
               {"counters",
                {{"element_evaluations", counters.element_evaluations},
                 {"factorizations", counters.factorizations},
                 {"solves", counters.solves},
                 {"steps", counters.steps}}}};
  if (!run.uncertainty.empty()) json["uncertainty_wall_s"] = run.uncertainty_wall_s;
  for (const EvaluationTime& timing : run.result.timings) {
    json["timings"][timing.name] = {{"each_s", timing.wall_s}, {"evaluations", timing.evaluations}};
  }
  return json;
}

/// What the computation had, why, and how often it was evaluated.
Json effects(const Run& run) {
  Json list = Json::array();
  for (const EffectReason& reason : run.result.effects) {
    Json json = {{"effect", std::string(solver::name_of(reason.effect))},
                 {"admitted", reason.applicable},
                 {"on", reason.active},
                 {"why", reason.why},
                 {"evaluations", run.result.counters.evaluations(reason.effect)}};
    if (reason.number) {
      json["number"] = number_or_null(reason.number);
      json["number_of"] = describe_effect_number(reason.effect, run.result.analysis);
    }
    if (reason.change) json["change"] = number_or_null(reason.change);
    list.push_back(std::move(json));
  }
  return list;
}

Json run_json(const Run& run) {
  Json json = {{"case", run.case_id},  {"variant", run.variant},       {"status", run.status},
               {"reason", run.reason}, {"quantities", Json::object()}, {"checks", Json::array()}};
  for (const auto& [name, quantity] : run.result.quantities) {
    json["quantities"][name] = numbers(quantity.values);
  }
  for (const CheckResult& check_result : run.check_results)
    json["checks"].push_back(check_result_json(check_result));
  json["convergence"] = Json::array();
  for (const Convergence& found : run.convergence) {
    json["convergence"].push_back(convergence(found));
  }
  if (!run.uncertainty.empty()) json["uncertainty"] = uncertainty(run.uncertainty);
  if (!run.result.effects.empty()) json["effects"] = effects(run);
  if (run.result.drawing) json["drawing"] = drawing_json(*run.result.drawing);
  json["cost"] = cost(run);
  return json;
}

Json case_json(const Case& given) {
  const Json& document = given.document.value();
  Json json = {{"title", given.title()}};
  for (const char* key : {"description", "family", "labels", "stress_suite", "figures", "tables"}) {
    if (document.contains(key)) json[key] = document.at(key);
  }
  json["analysis"] = analysis_kind(given.document);
  json["variants"] = Json::object();
  for (const std::string& variant : given.variants()) {
    json["variants"][variant] = {{"title", given.variant_title(variant)}};
  }
  return json;
}

Json reference_json(const CitedReference& cited) {
  const references::Reference& reference = cited.reference;
  Json json = {{"title", reference.title},
               {"kind", to_string(reference.kind)},
               {"unit", reference.unit},
               {"values", numbers(reference.values)},
               {"uncertainty", numbers(reference.uncertainty)},
               {"citation", cited.source.text},
               {"place", reference.place}};
  if (!cited.source.doi.empty()) json["doi"] = cited.source.doi;
  if (!reference.printed.empty()) json["printed"] = reference.printed;
  if (!reference.derivation.empty()) json["derivation"] = reference.derivation;
  if (!reference.errata.empty()) json["errata"] = reference.errata;
  if (!reference.notes.empty()) json["notes"] = reference.notes;
  return json;
}

}  // namespace

Json results_of(const std::vector<Run>& runs, const std::vector<Case>& cases,
                const References& references) {
  Json results = {{"format", 1},
                  {"environment", environment()},
                  {"cases", Json::object()},
                  {"references", Json::object()},
                  {"runs", Json::array()}};
  for (const Case& test_case : cases) results["cases"][test_case.id()] = case_json(test_case);
  for (const auto& [id, cited] : references.used()) {
    results["references"][id] = reference_json(cited);
  }
  if (const NumericalUncertaintySummary summary = numerical_uncertainty_of(runs);
      summary.levels > 0) {
    results["bands"] = {{"levels", summary.levels},
                        {"hits", summary.hits},
                        {"hit_rate", number_or_null(summary.hit_rate())},
                        {"least_hit_rate", kMinHitRate},
                        {"median_ratio", number_or_null(summary.median_ratio)},
                        {"largest_median_ratio", kMaxMedianRatio},
                        {"levels_to_judge", kMinLevels},
                        {"holds", !summary.fails()}};
  }
  for (const Run& run : runs) {
    if (!results["cases"].contains(run.case_id)) {
      // A case that could not be read is told of all the same.
      results["cases"][run.case_id] = {{"title", run.case_id}, {"variants", Json::object()}};
    }
    results["runs"].push_back(run_json(run));
  }
  return results;
}

fs::path write_results(const Json& results, const fs::path& folder) {
  fs::path file = folder / "results.json";
  write_file(file, pretty(results));
  return file;
}

void require_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  const fs::path probe = folder / ".trammel-probe";
  const bool written = static_cast<bool>(std::ofstream(probe) << ' ');
  fs::remove(probe, error);
  if (!written)
    throw InputError("--out " + folder.string() + ": expected a folder that can be written");
}

}  // namespace trammel::harness
