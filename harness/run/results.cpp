#include "harness/run/results.h"

#include <algorithm>
#include <cmath>

#include "harness/base/content_hash.h"
#include "harness/base/environment.h"
#include "harness/run/stored_results.h"

namespace trammel::harness {
namespace {

using results::Number;
using results::Numbers;

Number number(double value) {
  return std::isfinite(value) ? Number(value) : std::nullopt;
}
Number number(const std::optional<double>& value) {
  return value ? number(*value) : std::nullopt;
}

Numbers numbers(const std::vector<double>& values) {
  Numbers out;
  for (const double value : values) out.push_back(number(value));
  return out;
}

Numbers interval(const Validation& validation) {
  return {number(validation.low), number(validation.high)};
}

std::vector<results::Point> points(const std::vector<Eigen::Vector2d>& all) {
  std::vector<results::Point> out;
  for (const Eigen::Vector2d& point : all) out.emplace_back(point.x(), point.y());
  return out;
}

std::optional<results::Tolerance> tolerance(const CheckResult& check_result) {
  if (!check_result.window) return std::nullopt;
  return results::Tolerance{number(check_result.window->low), number(check_result.window->high),
                            check_result.symmetric};
}

results::Check check(const CheckResult& found) {
  results::Check check = found;
  check.tolerance = tolerance(found);
  return check;
}

results::Convergence convergence(const Convergence& found) {
  const Series& series = found.series;
  results::Convergence study;
  study.sweep = series.sweep;
  study.parameter = numbers(series.parameter);
  study.quantity = series.quantity;
  study.index = static_cast<int>(series.index);
  study.statistic = series.statistic;
  study.values = numbers(series.values);
  study.reference = series.reference;
  study.exact = number(series.exact);
  study.error = numbers(found.error);
  study.roundoff = numbers(series.roundoff);
  study.order = numbers(found.order);
  study.in_asymptotic_range = found.in_asymptotic_range;
  study.at_roundoff_floor = found.at_roundoff_floor;
  study.theory_order = number(series.theory);
  study.lower_order = number(series.lower);
  if (const auto& law = found.two_term) {
    study.two_term = {
        {number(law->coefficient[0]), number(law->coefficient[1])}, number(law->worst), law->used};
  }
  study.fitted_order = number(found.fitted_order);
  study.richardson = number(found.richardson);
  study.gci = numbers(found.gci);
  study.safety_factor = numbers(found.factor);
  return study;
}

results::Comparison comparison(const ComparedEntry& entry, const std::vector<StatedInput>& inputs) {
  results::Comparison out;
  out.check = entry.check;
  out.quantity = entry.quantity;
  out.index = static_cast<int>(entry.index);
  out.unit = entry.unit;
  out.reference = entry.reference;
  out.simulation = number(entry.comparison.simulation);
  out.expected = number(entry.comparison.reference);
  out.u_num = number(entry.comparison.u_num);
  out.u_input = number(entry.comparison.u_input);
  out.u_input_sampled = number(entry.u_input_sampled);
  out.u_reference = number(entry.comparison.u_reference);
  for (std::size_t k = 0; k < inputs.size(); ++k)
    out.contributions.emplace_back(inputs[k].name, number(entry.contribution[k]));
  out.dominant_input = entry.dominant;
  out.dominant_share = number(entry.dominant_share);
  out.spread = numbers(entry.spread);
  out.difference = number(entry.validation.difference);
  out.u_val = number(entry.validation.u_val);
  out.interval = interval(entry.validation);
  out.verdict = to_string(entry.validation.verdict);
  out.conclusion = entry.validation.text;
  out.all_inputs = {number(entry.literal_comparison.u_input),
                    number(entry.u_input_literal_sampled),
                    number(entry.literal.u_val),
                    interval(entry.literal),
                    to_string(entry.literal.verdict),
                    entry.literal.text};
  return out;
}

results::Uncertainty uncertainty(const ValidationUncertainty& found) {
  results::Uncertainty out;
  out.samples = found.samples;
  out.failed = found.failed;
  out.samples_all_inputs = found.literal_samples;
  out.failed_all_inputs = found.literal_failed;
  for (const StatedInput& input : found.inputs)
    out.inputs.push_back(
        {input.name, input.why, input.pointers, number(input.half_width), input.nominal});
  for (const NumericalEstimate& estimate : found.numerical)
    out.numerical.push_back({estimate.refinement, estimate.quantity,
                             static_cast<int>(estimate.index), numbers(estimate.parameter),
                             numbers(estimate.values), number(estimate.order),
                             number(estimate.factor), number(estimate.half_width)});
  for (const ComparedEntry& entry : found.entries)
    out.comparisons.push_back(comparison(entry, found.inputs));
  return out;
}

results::Drawing drawing(const Drawing& drawn) {
  results::Drawing out;
  out.nodes = points(drawn.nodes);
  for (const auto& member : drawn.members) out.members.emplace_back(member.begin(), member.end());
  for (const auto& triangle : drawn.triangles)
    out.triangles.emplace_back(triangle.begin(), triangle.end());
  for (const Drawing::Joint& joint : drawn.joints)
    out.joints.push_back({static_cast<int>(joint.node), joint.kind, joint.name});
  for (const Drawing::Shape& shape : drawn.shapes)
    out.shapes.push_back({shape.label, points(shape.displacement)});
  for (const Drawing::Pose& pose : drawn.poses)
    out.poses.push_back(
        {pose.label, points(pose.nodes), number(pose.time), points(pose.displacement)});
  return out;
}

results::Cost cost(const Run& run) {
  results::Cost out;
  out.wall_s = run.wall_s;
  out.cpu_s = run.cpu_s;
  out.counters = counters(run.result.counters);
  if (!run.uncertainty.empty()) out.uncertainty_wall_s = run.uncertainty_wall_s;
  for (const EvaluationTime& timing : run.result.timings)
    out.timings.push_back({timing.name, timing.wall_s, timing.evaluations});
  return out;
}

/// What the computation had, why, and how often it was evaluated.
std::vector<results::EffectRow> effects(const Run& run) {
  std::vector<results::EffectRow> rows;
  for (const EffectReason& reason : run.result.effects) {
    const std::string definition =
        reason.number ? describe_effect_number(reason.effect, run.result.analysis) : "";
    rows.push_back({std::string(solver::name_of(reason.effect)), definition, reason.why,
                    reason.applicable, reason.active,
                    run.result.counters.evaluations(reason.effect), number(reason.number),
                    number(reason.change)});
  }
  return rows;
}

results::Status status(const std::string& status) {
  using results::Status;
  for (const Status known :
       {Status::solved, Status::singular, Status::not_converged, Status::not_run, Status::cannot,
        Status::not_exported, Status::crashed, Status::timed_out})
    if (status == to_string(known)) return known;
  return Status::error;
}

results::Run run_results(const Run& run, bool with_series) {
  results::Run out;
  out.case_id = run.case_id;
  out.variant = run.variant;
  out.status = status(run.status);
  out.reason = run.reason;
  for (const solver::Residual kind : solver::kResiduals) {
    if (run.result.evidence.has(kind))
      out.residuals.emplace_back(solver::rule_of(kind).name,
                                 number(run.result.evidence.largest(kind)));
  }
  for (const Warning& warning : run.result.warnings) out.warnings.push_back(warning.text());
  if (with_series || run.stored.empty()) {
    results::Run series = stored_series(run);
    out.quantities = std::move(series.quantities);
    out.drawing = std::move(series.drawing);
  } else {
    for (const auto& [name, quantity] : run.result.quantities)
      if (quantity.values.size() <= kSummaryEntries)
        out.quantities.emplace_back(name, numbers(quantity.values));
  }
  out.stored = run.stored.filename().string();
  out.was_stored = run.was_stored;
  for (const CheckResult& found : run.check_results) out.checks.push_back(check(found));
  for (const Convergence& found : run.convergence) out.convergence.push_back(convergence(found));
  if (!run.uncertainty.empty()) out.uncertainty = uncertainty(run.uncertainty);
  out.effects = effects(run);
  out.model_probabilities = run.result.model_probabilities;
  out.cost = cost(run);
  return out;
}

results::CaseInfo case_info(const Case& given) {
  results::CaseInfo info;
  const Json& json = given.document.value();
  info.id = given.id();
  info.title = given.title();
  info.description = json.value("description", "");
  info.family = json.value("family", "");
  info.labels = json.value("labels", std::vector<std::string>{});
  for (const char* key : {"stress_suite"})
    if (json.contains(key)) info.stress_suite = results::read_stress_suite(json[key]);
  if (json.contains("figures")) info.figures = results::read_figures(json["figures"]);
  if (json.contains("tables")) info.tables = results::read_tables(json["tables"]);
  info.analysis = analysis_kind(given.document);
  info.hash = case_hash(given);
  for (const std::string& variant : given.variants())
    info.variants.push_back({variant, given.variant_title(variant)});
  return info;
}

results::Reference reference(const std::string& id, const CitedReference& cited) {
  const references::Reference& source = cited.reference;
  results::Reference out;
  out.id = id;
  out.title = source.title;
  out.kind = to_string(source.kind);
  out.unit = source.unit;
  out.values = numbers(source.values);
  out.uncertainty = numbers(source.uncertainty);
  out.citation = cited.source.text;
  out.place = source.place;
  out.doi = cited.source.doi;
  out.printed = source.printed;
  out.derivation = source.derivation;
  out.errata = source.errata;
  out.notes = source.notes;
  return out;
}

results::UncertaintyCoverage coverage(const NumericalUncertaintySummary& summary) {
  return {static_cast<int>(summary.levels),
          static_cast<int>(summary.hits),
          static_cast<int>(kMinLevels),
          number(summary.hit_rate()),
          kMinHitRate,
          number(summary.median_ratio),
          kMaxMedianRatio,
          !summary.fails()};
}

}  // namespace

std::string case_hash(const Case& given) {
  return content_hash(given.document.value().dump());
}

results::Run stored_series(const Computation& computation) {
  results::Run out;
  for (const auto& [name, quantity] : computation.result.quantities)
    out.quantities.emplace_back(name, numbers(quantity.values));
  if (computation.result.drawing) out.drawing = drawing(*computation.result.drawing);
  return out;
}

results::Counters counters(const solver::Counters& counters) {
  return {{"element_evaluations", counters.element_evaluations},
          {"factorizations", counters.factorizations},
          {"solves", counters.solves},
          {"steps", counters.steps}};
}

results::Results results_of(const std::vector<Run>& runs, const std::vector<Case>& cases,
                            const References& references, bool with_series) {
  results::Results out;
  out.environment = results::read_environment(environment());
  out.environment.stored_runs =
      static_cast<int>(std::ranges::count_if(runs, [](const Run& run) { return run.was_stored; }));
  for (const Case& test_case : cases) out.cases.push_back(case_info(test_case));
  for (const auto& [id, cited] : references.used()) out.references.push_back(reference(id, cited));
  const NumericalUncertaintySummary summary = numerical_uncertainty_of(runs);
  if (summary.levels > 0) out.uncertainty_coverage = coverage(summary);
  for (const Run& run : runs) {
    const bool is_known = std::ranges::any_of(
        out.cases, [&](const results::CaseInfo& info) { return info.id == run.case_id; });
    // A case that could not be read is reported all the same.
    if (!is_known) {
      results::CaseInfo unread;
      unread.id = unread.title = run.case_id;
      out.cases.push_back(std::move(unread));
    }
    if (!run.stored.empty()) out.store = run.stored.parent_path().string();
    out.runs.push_back(run_results(run, with_series));
  }
  return out;
}

}  // namespace trammel::harness
