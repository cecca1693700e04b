#include "harness/analysis/analyze_study.h"

#include <cmath>
#include <limits>

#include "harness/analysis/analysis.h"
#include "harness/base/number.h"
#include "harness/base/statistic.h"
#include "harness/input/case.h"
#include "harness/input/json_view.h"

namespace trammel::harness {
namespace {

/// Returns the case with the analysis that the study repeats (inner analysis) in place of the
/// study.
Document case_with_inner_analysis(Document document) {
  const Json inner = document.value().at("analysis").at("study").at("analysis");
  const Origin written = document.origin("/analysis/study/analysis");
  document.apply_patch(written.file, written.pointer, {{"analysis", {{"study", nullptr}}}});
  document.apply_patch(written.file, written.pointer, {{"analysis", inner}});
  return document;
}

double status_code(solver::Status status) {
  return status == solver::Status::solved ? 0 : status == solver::Status::singular ? 1 : 2;
}

/// Number that a parameter study records, and its relative round-off error (-1 if unknown).
struct KeptQuantity {
  double value = kNaN, roundoff = -1;
};

/// Returns the value that a parameter study records for a quantity of the repeated (inner)
/// analysis.
/// @throws InputError  if the quantity does not exist, or has several numbers and neither 'index'
/// nor 'statistic' selects a number.
KeptQuantity select_kept_quantity(const Quantities& quantities, const std::string& name,
                                  const JsonView& keep) {
  const auto found = quantities.find(name);
  if (found == quantities.end()) {
    std::string some;
    for (const auto& item : quantities) some += (some.empty() ? "" : ", ") + item.first;
    throw keep.error("the analysis does not compute this quantity; expected one of " + some);
  }
  const std::vector<double>& values = found->second.values;
  const std::vector<double>& roundoff = found->second.roundoff;
  if (keep.has("statistic"))
    return {statistic_of(keep.text("statistic"), values),
            roundoff.empty() ? -1 : statistic_of("max", roundoff)};
  const auto index = keep.get<std::size_t>("index", 0);
  if (!keep.has("index") && values.size() != 1)
    throw keep.error("the quantity has " + std::to_string(values.size()) +
                     " numbers; expected 'index' or 'statistic'");
  if (index >= values.size()) return {};
  return {values[index], index < roundoff.size() ? roundoff[index] : -1};
}

std::vector<double> reference_values(const std::vector<KeptQuantity>& kept, const JsonView& keep,
                                     const References& references) {
  if (!keep.has("reference")) {
    const KeptQuantity& one = keep.text("relative_to") == "first" ? kept.front() : kept.back();
    return std::vector<double>(kept.size(), one.value);
  }
  const references::Reference& reference = references.get(keep["reference"]);
  if (reference.values.size() != kept.size())
    throw keep["reference"].error("expected a reference of " + std::to_string(kept.size()) +
                                  " values (got " + std::to_string(reference.values.size()) + ")");
  return reference.values;
}

/// Records the relative errors of a quantity at all parameter values, their ratios to the predicted
/// round-off error, and the parameter with the smallest error.
void record_relative_errors(const std::string& name, const std::vector<KeptQuantity>& kept,
                            const std::vector<double>& parameter, const JsonView& keep,
                            const References& references, Recorder& record) {
  if (!keep.has("reference") && !keep.has("relative_to")) return;
  const std::vector<double> reference_solution = reference_values(kept, keep, references);
  double min_error = std::numeric_limits<double>::infinity(), best = kNaN;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double error =
        std::abs(kept[i].value - reference_solution[i]) / std::abs(reference_solution[i]);
    record.add_or_missing("relative_error", name, error);
    if (error < min_error) {
      min_error = error;
      best = parameter[i];
    }
    if (kept[i].roundoff >= 0) {
      record.add("roundoff", name, kept[i].roundoff);
      record.add("error_over_roundoff", name, error / kept[i].roundoff);
    } else if (std::isnan(kept[i].value)) {
      record.add_missing_value("roundoff", name);
      record.add_missing_value("error_over_roundoff", name);
    }
  }
  if (keep.has("reference") && !std::isnan(best)) record.add("min_error_at", name, best);
}

/// Returns a case for each point of the platform's trajectory. The parameter of the study is the
/// time.
std::vector<Level> path_point_levels(const Document& document, const JsonView& study) {
  const CaseModel case_model = read_case_model(document);
  if (!case_model.path) throw study["trajectory"].error("this key requires /model/trajectory");
  const Origin written = document.origin("/model/trajectory");
  std::vector<Level> found;
  for (const solver::TrajectoryPoint& point : case_model.motion) {
    const solver::Pose& pose = point.pose;
    const Json place = {{"x_m", pose.x}, {"y_m", pose.y}, {"phi_rad", pose.phi}};
    found.push_back({point.time, document});
    found.back().document.apply_patch(written.file, written.pointer,
                                      {{"model", {{"trajectory", nullptr}, {"pose", place}}}});
  }
  return found;
}

}  // namespace

std::vector<Level> cases_of_study_levels(const Document& document) {
  const JsonView study = JsonView(document)["analysis"]["study"];
  if (study["analysis"].has("study"))
    throw study["analysis"].error("a study cannot contain a study; expected another analysis");
  const bool along = study.get("trajectory", false);
  if (along == study.has("values"))
    throw study.error("expected exactly one of 'values' and 'trajectory'");
  auto found = along ? path_point_levels(document, study) : sweep_levels(document, study);
  for (Level& level : found) level.document = case_with_inner_analysis(std::move(level.document));
  return found;
}

StepResult analyze_study(const Document& document, const References& references, bool draw,
                         Recorder& record) {
  const JsonView study = JsonView(document)["analysis"]["study"];
  const auto kept_places = study.find("quantities");
  const auto keep =
      kept_places ? kept_places->entries() : std::vector<std::pair<std::string, JsonView>>{};
  std::vector<std::vector<KeptQuantity>> kept(keep.size());
  std::vector<double> parameter;
  StepResult result;
  for (const Level& level : cases_of_study_levels(document)) {
    AnalysisResult found = analyze(level.document, references, {draw && !result.drawing});
    parameter.push_back(level.parameter);
    record.add(study.get<std::string>("parameter", "parameter"), level.parameter);
    record.add("status", status_code(found.outcome.status));
    for (std::size_t k = 0; k < keep.size(); ++k) {
      const auto& [name, place] = keep[k];
      kept[k].push_back(found.outcome.solved() ? select_kept_quantity(found.quantities, name, place)
                                               : KeptQuantity{});
    }
    result.counters += found.counters;
    add_warnings(result.warnings, found.warnings);
    if (found.drawing) result.drawing = std::move(found.drawing);
  }
  if (study.get("trajectory", false))
    warn_of_crossed_singularity(read_case_model(document), result.warnings);
  for (std::size_t k = 0; k < keep.size(); ++k) {
    const auto& [name, place] = keep[k];
    for (const KeptQuantity& one : kept[k]) record.add_or_missing(name, "", one.value);
    record_relative_errors(name, kept[k], parameter, place, references, record);
  }
  return result;
}

}  // namespace trammel::harness
