#include "harness/coverage/case_features.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "harness/input/schema_rules.h"

namespace trammel::harness {
namespace {

/// Walks through the schema, beside a document or alone.
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
  /// @param value  null: all that the rule allows
  void visit(const SchemaRule& stated, const Json* value, const std::string& context) {
    if (const SchemaRule* reference = keyword(stated, "$ref")) {
      const std::string path = text_of(*reference);
      const std::string name = path.substr(path.rfind('/') + 1);
      if (value != nullptr || seen_.insert(name).second)
        visit(resolved(root_, stated), value, name);
      return;
    }
    if (const SchemaRule* alternatives = keyword(stated, "anyOf"))
      for (const SchemaRule& one : alternatives->GetArray()) visit(one, value, context);
    if (const SchemaRule* choices = keyword(stated, "enum"))
      for (const SchemaRule& choice : choices->GetArray()) visit_choice(choice, value, context);
    if (const SchemaRule* items = keyword(stated, "items"))
      visit_each(*items, value, context, true);
    if (const SchemaRule* others = keyword(stated, "additionalProperties"))
      if (others->IsObject()) visit_each(*others, value, context, false);
    if (const SchemaRule* properties = keyword(stated, "properties"))
      for (const auto& item : properties->GetObject()) visit_key(item, value, context);
  }

  void visit_choice(const SchemaRule& choice, const Json* value, const std::string& context) {
    if (!choice.IsString()) return;
    const std::string text = text_of(choice);
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
    const std::string key = text_of(item.name);
    if (value != nullptr && (!value->is_object() || !value->contains(key))) return;
    features_.insert(context + "." + key);
    visit(item.value, value == nullptr ? nullptr : &value->at(key), context + "." + key);
  }

  const SchemaRule& root_;
  CaseFeatures features_;
  std::set<std::string> seen_;
};

}  // namespace

CaseFeatures features_of_schema() {
  return FeatureWalk().run(nullptr);
}

CaseFeatures features_of(const Json& document) {
  return FeatureWalk().run(&document);
}

std::string analysis_name(const Json& document) {
  const Json& analysis = document.at("analysis");
  return analysis.empty() ? "" : analysis.begin().key();
}

CaseFeatures parts_of(const CaseFeatures& features) {
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

}  // namespace trammel::harness
