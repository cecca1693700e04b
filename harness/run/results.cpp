#include "harness/run/results.h"

#include <algorithm>
#include <iterator>

#include "harness/base/environment.h"
#include "harness/base/find_or_add.h"
#include "harness/input/catalogue.h"
#include "harness/judge/convergence.h"
#include "harness/results/result_fields.h"

namespace trammel::harness {
namespace {

using results::Status;

Status status_from_solver(solver::Status status) {
  switch (status) {
    case solver::Status::solved:
      return Status::solved;
    case solver::Status::singular:
      return Status::singular;
    case solver::Status::not_converged:
      return Status::not_converged;
  }
  return Status::error;
}

/// Rounds the displacements in poses and mode shapes to seven digits. Seven digits suffice for
/// drawing, and for matching of modes, because the error of the overlap is of second order.
void reduce_drawing_precision(results::Drawing& drawing) {
  const auto round = [](std::vector<results::Point>& points) {
    for (auto& [x, y] : points) x = static_cast<float>(x), y = static_cast<float>(y);
  };
  for (results::Pose& pose : drawing.poses) round(pose.nodes), round(pose.displacement);
  for (results::Shape& shape : drawing.shapes) round(shape.displacement);
}

/// Adds the numbers, texts and short lists at `place` in the model to the inputs of a case.
void add_case_inputs(const Document& document, const JsonPointer& place, results::CaseInfo& info) {
  constexpr std::size_t kMaxLength = 60, kMaxInputs = 60;
  const Json& json = document.value().at(place);
  if (json.is_object())
    for (const auto& item : json.items()) add_case_inputs(document, place / item.key(), info);
  if (json.is_object() || info.inputs.size() == kMaxInputs) return;
  const std::string text = json.is_string() ? json.get<std::string>() : json.dump();
  if (text.size() > kMaxLength) return;
  const std::string pointer = place.to_string(), file = document.origin(pointer).file;
  // A case does not inherit the id of the case that it extends.
  const bool is_own = file == document.origin("/id").file;
  info.inputs.push_back({pointer.substr(std::string("/model/").size()), text,
                         is_own ? "" : std::filesystem::path(file).filename().string()});
}

results::CaseInfo create_case_info(const Case& given) {
  const Json& stated = given.document.value();
  Json json = {{"title", given.title()},
               {"variants", Json::object()},
               {"analysis", analysis_kind(given.document)},
               {"hash", case_hash(given)}};
  for (const char* key : {"description", "family", "labels", "stress_suite", "figures", "tables"})
    if (stated.contains(key)) json[key] = stated[key];
  for (const std::string& variant : given.variants())
    json["variants"][variant]["title"] = given.variant_title(variant);
  auto info = results::from_json<results::CaseInfo>(json);
  info.id = given.id();
  if (!is_in_catalogue(given.file))
    info.file = std::filesystem::absolute(given.file).lexically_normal().string();
  const Document base = patched(given, kBaseVariant);
  if (base.value().contains("model")) add_case_inputs(base, JsonPointer("/model"), info);
  return info;
}

results::Reference create_result_reference(const std::string& id, const CitedReference& cited) {
  const references::Reference& source = cited.reference;
  results::Reference out;
  out.id = id;
  out.title = source.title;
  out.kind = to_string(source.kind);
  out.unit = source.unit;
  out.values = {source.values.begin(), source.values.end()};
  out.uncertainty = {source.uncertainty.begin(), source.uncertainty.end()};
  out.citation = cited.source.text;
  out.place = source.place;
  out.doi = cited.source.doi;
  out.printed = source.printed;
  out.derivation = source.derivation;
  out.errata = source.errata;
  out.ambiguities = source.ambiguities;
  out.notes = source.notes;
  return out;
}

}  // namespace

void record_result(AnalysisResult result, Run& run) {
  run.status = status_from_solver(result.outcome.status);
  run.reason = std::move(result.outcome.reason);
  for (const solver::Residual kind : solver::kResiduals)
    if (result.evidence.has(kind))
      run.residuals.emplace_back(solver::residual_rule(kind).name, result.evidence.largest(kind));
  for (const Warning& warning : result.warnings) run.warnings.push_back(warning.text());
  run.quantities = std::move(result.quantities);
  run.effects = std::move(result.effects);
  for (std::size_t i = 0; i < run.effects.size(); ++i)
    run.effects[i].evaluations = result.counters.evaluations(static_cast<solver::Effect>(i));
  run.model_probabilities = std::move(result.model_probabilities);
  run.drawing = std::move(result.drawing);
  if (run.drawing) reduce_drawing_precision(*run.drawing);
  run.cost.counters = named_counters(result.counters);
  run.cost.timings = std::move(result.timings);
}

std::string case_hash(const Case& given) {
  return content_hash(given.document.value().dump());
}

results::Results collect_results(std::vector<Run> runs, const std::vector<Case>& cases,
                                 const References& references, const std::filesystem::path& store) {
  results::Results out;
  out.environment = results::from_json<results::Environment>(build_and_machine_info());
  out.environment.stored_runs =
      static_cast<int>(std::ranges::count_if(runs, [](const Run& run) { return run.was_stored; }));
  std::ranges::transform(cases, std::back_inserter(out.cases), create_case_info);
  for (const auto& [id, cited] : references.requested_references())
    out.references.push_back(create_result_reference(id, cited));
  out.uncertainty_coverage = summarize_numerical_uncertainty(runs);
  if (out.uncertainty_coverage->levels == 0) out.uncertainty_coverage.reset();
  for (const Run& run : runs) {
    const bool is_known = contains(out.cases, run.case_id, &results::CaseInfo::id);
    // A case file that could not be read is missing from `cases`. The id of its run is added here.
    if (!is_known) {
      results::CaseInfo unread;
      unread.id = unread.title = run.case_id;
      out.cases.push_back(std::move(unread));
    }
    if (!run.stored.empty()) out.store = store.string();
  }
  out.runs = std::move(runs);
  return out;
}

}  // namespace trammel::harness
