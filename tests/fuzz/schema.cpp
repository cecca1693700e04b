#include "tests/fuzz/schema.h"

#include <algorithm>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"

namespace trammel::fuzz {
namespace {

bool is_of_type(const Json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  return type == "object"   ? value.is_object()
         : type == "array"  ? value.is_array()
         : type == "number" ? value.is_number()
         : type == "string" ? value.is_string()
         : type == "null"   ? value.is_null()
                            : value.is_boolean();
}

void walk(const Schema& schema, const Json& value, const Place& place, std::vector<Place>& found) {
  found.push_back(place);
  if (!value.is_structured()) return;
  for (const auto& item : value.items()) {
    Place inner{place.at, schema.rules_of_entry(place.rules, item.key()), place.is_certain};
    value.is_array() ? inner.at.push_back(std::to_string(std::stoul(item.key())))
                     : inner.at.push_back(item.key());
    inner.is_certain = place.is_certain && inner.rules.size() == 1;
    walk(schema, item.value(), inner, found);
  }
}

}  // namespace

Schema::Schema(const std::string& name)
    : root_(harness::read_json(harness::data_root() / "cases/schema" / (name + ".schema.json"))) {}

std::vector<Place> Schema::places(const Json& document) const {
  std::vector<Place> found;
  walk(*this, document, {JsonPointer(), {&root_}, true}, found);
  return found;
}

std::vector<const Json*> Schema::alternatives(const Json& rule) const {
  if (rule.contains("$ref"))
    return alternatives(root_.at(JsonPointer(rule.at("$ref").get<std::string>().substr(1))));
  if (!rule.contains("anyOf")) return {&rule};
  std::vector<const Json*> all;
  for (const Json& choice : rule.at("anyOf")) {
    const auto some = alternatives(choice);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

std::vector<const Json*> Schema::rules_of_entry(const std::vector<const Json*>& rules,
                                                const std::string& key) const {
  std::vector<const Json*> all;
  for (const Json* rule : rules) {
    const Json* entry = nullptr;
    if (rule->contains("properties") && rule->at("properties").contains(key))
      entry = &rule->at("properties").at(key);
    else if (rule->contains("additionalProperties") && rule->at("additionalProperties").is_object())
      entry = &rule->at("additionalProperties");
    else if (rule->contains("items"))
      entry = &rule->at("items");
    if (entry == nullptr) continue;
    for (const Json* alternative : alternatives(*entry))
      if (std::find(all.begin(), all.end(), alternative) == all.end()) all.push_back(alternative);
  }
  return all;
}

bool forbids(const Json& rule, const Json& value) {
  if (rule.contains("enum")) {
    const Json& words = rule.at("enum");
    return std::find(words.begin(), words.end(), value) == words.end();
  }
  if (rule.contains("type")) {
    const Json types =
        rule.at("type").is_array() ? rule.at("type") : Json::array({rule.at("type")});
    const bool fits = std::any_of(types.begin(), types.end(), [&](const Json& type) {
      return is_of_type(value, type.get<std::string>());
    });
    if (!fits) return true;
  }
  if (value.is_object() && rule.contains("required"))
    for (const Json& key : rule.at("required"))
      if (!value.contains(key.get<std::string>())) return true;
  if (!value.is_number()) return false;
  const auto number = value.get<double>();
  return (rule.contains("minimum") && number < rule.at("minimum").get<double>()) ||
         (rule.contains("maximum") && number > rule.at("maximum").get<double>()) ||
         (rule.contains("exclusiveMinimum") && number <= rule.at("exclusiveMinimum").get<double>());
}

}  // namespace trammel::fuzz
