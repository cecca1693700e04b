#include "harness/coverage/evidence_coverage.h"

#include <map>
#include <set>
#include <tuple>

#include "harness/base/data_root.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/coverage/case_features.h"
#include "harness/input/check.h"
#include "harness/results/quantity_definitions.h"

namespace trammel::harness {
namespace {

using results::CoverageRow;
using Kinds = std::set<std::string>;

std::string kind_of(references::ReferenceKind kind) {
  switch (kind) {
    case references::ReferenceKind::paper:
      return "published";
    case references::ReferenceKind::code:
      return "code";
    default:
      return "exact";
  }
}

/// What a check is evidence of; empty: of nothing.
std::string kind_of(const Check& check, const Document& document, const References& references) {
  const bool only_shown = check.role == Role::validation && check.windows.empty();
  if (check.negative_control || only_shown || check.expectation == Expectation::known_discrepancy)
    return "";
  if (!check.reference.empty())
    return kind_of(references.get(JsonView(document)["checks"][check.name]["reference"]).kind);
  const std::string analysis = analysis_name(document.value());
  if (analysis == "study" && check.quantity.rfind("relative_error:", 0) == 0) {
    const Json& kept = document.value().at("analysis").at("study").at("quantities");
    const std::string name = check.quantity.substr(check.quantity.find(':') + 1);
    if (kept.contains(name) && kept.at(name).contains("reference")) {
      const JsonView quantities = JsonView(document)["analysis"]["study"]["quantities"];
      return kind_of(references.get(quantities[name]["reference"]).kind);
    }
  }
  return analysis == "manufactured" ? "manufactured" : "self-consistency";
}

/// "modes: frequency_Hz", of a study the analysis that it repeats; empty: of none.
std::string quantity_row(const std::string& quantity, const std::string& analysis) {
  const auto* definition = results::find_quantity_definition(quantity, analysis);
  return definition == nullptr ? "" : analysis + ": " + definition->name;
}

class Coverage {
 public:
  Coverage() {
    for (const std::string& feature : features_of_schema()) add("key", feature);
    for (const auto& definition : results::quantity_definitions())
      for (const std::string& analysis : definition.analyses)
        add("quantity", analysis + ": " + definition.name);
  }

  void add_variant(const Document& document, const std::vector<Check>& checks,
                   const References& references) {
    const std::string analysis = analysis_name(document.value());
    Kinds kinds;
    for (const Check& check : checks) {
      const std::string kind = kind_of(check, document, references);
      if (kind.empty()) continue;
      kinds.insert(kind);
      const std::string quantity = quantity_row(check.quantity, analysis);
      if (!quantity.empty()) add("quantity", quantity, {kind});
    }
    const CaseFeatures features = features_of(document.value());
    for (const std::string& feature : features) add("key", feature, kinds);
    for (const std::string& part : parts_of(features))
      add("pair", analysis + " with " + part, kinds);
  }

  [[nodiscard]] std::vector<CoverageRow> rows() const {
    std::vector<CoverageRow> all;
    for (const auto& [name, kinds] : rows_)
      all.push_back({name.first, name.second, {kinds.begin(), kinds.end()}});
    return all;
  }

 private:
  void add(const std::string& group, const std::string& feature, const Kinds& kinds = {}) {
    rows_[{group, feature}].insert(kinds.begin(), kinds.end());
  }

  std::map<std::pair<std::string, std::string>, Kinds> rows_;
};

/// Whether a name stated is the feature; "*: time_s" is that quantity of all analyses.
bool means(const std::string& stated, const std::string& feature) {
  if (stated.rfind("*: ", 0) != 0) return stated == feature;
  const std::string end = stated.substr(1);
  return feature.size() > end.size() &&
         feature.compare(feature.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::vector<CoverageRow> evidence_coverage(const std::vector<Case>& cases,
                                           const References& references) {
  Coverage coverage;
  for (const Case& one : cases) {
    const std::vector<std::string> variants = one.variants();
    for (const std::string& variant : variants) {
      const Document document = patched(one, variant);
      coverage.add_variant(document, read_checks(document, variant, variants), references);
    }
  }
  return coverage.rows();
}

void add_reasons(std::vector<CoverageRow>& rows) {
  const auto file = data_root() / "cases" / "schema" / "without_evidence.json";
  const Json stated = read_json(file);
  for (const auto& [group, reasons] : stated.items()) {
    for (const auto& [reason, names] : reasons.items()) {
      for (const Json& name : names) {
        bool found = false;
        for (CoverageRow& row : rows) {
          if (row.group != group || row.is_verified() || !means(name, row.feature)) continue;
          row.reason = reason;
          found = true;
        }
        if (!found)
          throw InputError(file.string(), "/" + group,
                           "expected a feature without independent evidence (got '" +
                               name.get<std::string>() + "')");
      }
    }
  }
}

void count_series(const results::Results& results, std::vector<CoverageRow>& rows) {
  std::map<std::string, std::pair<int, int>> counts;
  for (const results::Run& run : results.runs) {
    std::set<std::string> judged;
    for (const results::Check& check : run.checks)
      if (check.verdict == results::Verdict::pass) judged.insert(check.quantity);
    for (const auto& item : run.quantities) {
      auto& [series, with_check] =
          counts[quantity_row(item.first, results.case_info(run.case_id).analysis)];
      ++series;
      with_check += judged.count(item.first) > 0 ? 1 : 0;
    }
  }
  for (CoverageRow& row : rows)
    if (row.group == "quantity") std::tie(row.series, row.judged) = counts[row.feature];
}

}  // namespace trammel::harness
