#include "harness/coverage/evidence_coverage.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <tuple>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/input/check.h"
#include "harness/input/schema_rules.h"
#include "harness/results/quantity_definitions.h"

namespace trammel::harness {
namespace {

using results::CoverageRow;
using Kinds = std::set<std::string>;

/// Collects all features of the case schema, or the features that a document uses.
class FeatureWalk {
 public:
  FeatureWalk() : root_(load_schema("case")) {}

  CaseFeatures run(const Json* document) {
    const SchemaRule& properties = *keyword(root_, "properties");
    for (const char* part : {"model", "analysis", "effects"}) {
      if (document == nullptr || document->contains(part))
        visit(*keyword(properties, part), document == nullptr ? nullptr : &document->at(part),
              part);
    }
    return std::move(features_);
  }

 private:
  /// @param value  part of the document; null: all values that the schema rule allows
  void visit(const SchemaRule& stated, const Json* value, const std::string& context) {
    if (const SchemaRule* reference = keyword(stated, "$ref")) {
      const std::string path = schema_string(*reference), name = path.substr(path.rfind('/') + 1);
      if (value || seen_.insert(name).second) visit(resolve_ref(root_, stated), value, name);
      return;
    }
    if (const SchemaRule* alternatives = keyword(stated, "anyOf"))
      for (const SchemaRule& one : alternatives->GetArray()) visit(one, value, context);
    if (const SchemaRule* choices = keyword(stated, "enum"))
      for (const SchemaRule& choice : choices->GetArray()) visit_choice(choice, value, context);
    if (const auto* items = keyword(stated, "items")) visit_each(*items, value, context, true);
    if (const SchemaRule* others = keyword(stated, "additionalProperties"))
      if (others->IsObject()) visit_each(*others, value, context, false);
    if (const SchemaRule* properties = keyword(stated, "properties"))
      for (const auto& item : properties->GetObject()) visit_key(item, value, context);
  }

  void visit_choice(const SchemaRule& choice, const Json* value, const std::string& context) {
    if (!choice.IsString()) return;
    const std::string text = schema_string(choice);
    if (value == nullptr || *value == text) features_.insert(context + " = " + text);
  }

  void visit_each(const SchemaRule& rule, const Json* value, const std::string& context,
                  bool of_array) {
    if (value == nullptr) return visit(rule, nullptr, context);
    if (of_array ? !value->is_array() : !value->is_object()) return;
    for (const Json& inner : *value) visit(rule, &inner, context);
  }

  template <class Item>
  void visit_key(const Item& item, const Json* value, const std::string& context) {
    const std::string key = schema_string(item.name);
    if (value != nullptr && (!value->is_object() || !value->contains(key))) return;
    features_.insert(context + "." + key);
    visit(item.value, value == nullptr ? nullptr : &value->at(key), context + "." + key);
  }

  const SchemaRule& root_;
  CaseFeatures features_;
  std::set<std::string> seen_;
};

/// Returns the kind of analysis, which is the key below "analysis".
std::string analysis_kind_of_case(const Json& document) {
  const Json& analysis = document.at("analysis");
  return analysis.empty() ? "" : analysis.begin().key();
}

/// Returns the features that name components of a model: parts, elements and joints.
CaseFeatures component_features(const CaseFeatures& features) {
  static constexpr std::array<std::string_view, 24> parts = {
      "model.members",        "model.plates",
      "model.edges",          "model.rigid_bodies",
      "model.point_masses",   "model.springs",
      "model.pins",           "model.sliders",
      "model.axial_springs",  "model.loads",
      "model.follower_loads", "model.gravity_m_s2",
      "member.taper",         "member.arc_center_m",
      "member.load_N_per_m",  "beam = ",
      "axial = inextensible", "mass_matrix = lumped",
      "plate.element = ",     "platform.kind = ",
      "active_joint = ",      "elbow_joint = ",
      "platform_joint = ",    "member.ends = hinged"};
  CaseFeatures found;
  for (const std::string& feature : features) {
    const bool is_part = std::ranges::any_of(parts, [&](std::string_view part) {
      return part.back() == ' ' ? feature.rfind(part, 0) == 0 : feature == part;
    });
    if (is_part) found.insert(feature);
  }
  return found;
}

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

/// Returns the kind of evidence that a check provides; empty if it provides no evidence.
std::string kind_of(const Check& check, const Document& document, const References& references) {
  const bool only_shown = check.role == Role::validation && check.windows.empty();
  if (check.negative_control || only_shown || check.expectation == Expectation::known_discrepancy)
    return "";
  if (!check.reference.empty())
    return kind_of(references.get(JsonView(document)["checks"][check.name]["reference"]).kind);
  const std::string analysis = analysis_kind_of_case(document.value());
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

/// Returns the name of the coverage row of a quantity, such as "modes: frequency_Hz"; empty if the
/// quantity is not defined for the analysis.
std::string coverage_row_name(const std::string& quantity, const std::string& analysis) {
  const auto* definition = results::find_quantity_definition(quantity, analysis);
  return definition == nullptr ? "" : analysis + ": " + definition->name;
}

class Coverage {
 public:
  Coverage() {
    for (const std::string& feature : case_features_of_schema()) add("key", feature);
    for (const auto& definition : results::quantity_definitions())
      for (const std::string& analysis : definition.analyses)
        add("quantity", analysis + ": " + definition.name);
  }

  void add_variant(const Document& document, const std::vector<Check>& checks,
                   const References& references) {
    const std::string analysis = analysis_kind_of_case(document.value());
    Kinds kinds;
    for (const Check& check : checks) {
      const std::string kind = kind_of(check, document, references);
      if (kind.empty()) continue;
      kinds.insert(kind);
      const std::string quantity = coverage_row_name(check.quantity, analysis);
      if (!quantity.empty()) add("quantity", quantity, {kind});
    }
    const CaseFeatures features = features_of_document(document.value());
    for (const std::string& feature : features) add("key", feature, kinds);
    for (const std::string& part : component_features(features))
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

/// Returns true if the name `stated` denotes the feature. The name "*: time_s" denotes the quantity
/// time_s of every analysis.
bool means(const std::string& stated, const std::string& feature) {
  if (stated.rfind("*: ", 0) != 0) return stated == feature;
  const std::string end = stated.substr(1);
  return feature.size() > end.size() &&
         feature.compare(feature.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

CaseFeatures case_features_of_schema() {
  return FeatureWalk().run(nullptr);
}

CaseFeatures features_of_document(const Json& document) {
  return FeatureWalk().run(&document);
}

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

void explain_missing_evidence(std::vector<CoverageRow>& rows) {
  const auto file = data_root() / "cases" / "schema" / "without_evidence.json";
  const Json stated = read_json(file);
  for (const auto& [group, reasons] : stated.items())
    for (const auto& [reason, names] : reasons.items())
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

void count_quantity_runs(const results::Results& results, std::vector<CoverageRow>& rows) {
  std::map<std::string, std::pair<int, int>> counts;
  for (const results::Run& run : results.runs) {
    std::set<std::string> judged;
    for (const results::Check& check : run.checks)
      if (check.verdict == results::Verdict::pass) judged.insert(check.quantity);
    for (const auto& item : run.quantities) {
      auto& [series, with_check] =
          counts[coverage_row_name(item.first, results.case_info(run.case_id).analysis)];
      ++series;
      with_check += judged.count(item.first) > 0 ? 1 : 0;
    }
  }
  for (CoverageRow& row : rows)
    if (row.group == "quantity") std::tie(row.series, row.judged) = counts[row.feature];
}

}  // namespace trammel::harness
