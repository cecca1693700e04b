#include <algorithm>
#include <cctype>
#include <cmath>
#include <unordered_map>

#include "harness/input/document.h"
#include "harness/input/schema_rules.h"

namespace trammel::harness {
namespace {

bool equals(const Json& value, const SchemaRule& choice) {
  if (value.is_string() && choice.IsString()) return value == schema_string(choice);
  return value.is_number() && choice.IsNumber() && value.get<double>() == choice.GetDouble();
}

/// Matches the only pattern of the schemas, ^[A-Za-z0-9][A-Za-z0-9._-]*$. Compiling it as a
/// std::regex takes seven million instructions.
bool matches_name_pattern(const std::string& text) {
  const auto plain = [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; };
  return !text.empty() && plain(text.front()) && std::ranges::all_of(text, [&](char c) {
    return plain(c) || c == '.' || c == '_' || c == '-';
  });
}

bool has_unique_elements(const Json& array) {
  for (auto item = array.begin(); item != array.end(); ++item)
    if (std::find(array.begin(), item, *item) != item) return false;
  return true;
}

bool has_all(const Json& object, const SchemaRule& keys) {
  return std::all_of(keys.Begin(), keys.End(),
                     [&](const SchemaRule& key) { return object.contains(key.GetString()); });
}

/// Returns true if a number has no fraction, in any notation: 2, 2.0 and 2e0 alike.
bool is_whole_number(const Json& value) {
  if (!value.is_number_float()) return value.is_number_integer();
  return std::trunc(value.get<double>()) == value.get<double>();
}

/// Returns true if a JSON value has a type that the schema rule allows.
bool has_type(const Json& value, const SchemaRule& rule) {
  return keyword(rule, "type") == nullptr || rule_allows_type(rule, value.type_name()) ||
         (is_whole_number(value) && rule_allows_type(rule, "integer"));
}

/// Returns true if a JSON value satisfies one keyword of a schema, such as "minimum". The type and
/// nested values are not examined.
bool obeys(const Json& value, std::string_view name, const SchemaRule& limit) {
  if (name == "enum")
    return std::any_of(limit.Begin(), limit.End(),
                       [&](const SchemaRule& choice) { return equals(value, choice); });
  if (value.is_number()) {
    if (name == "minimum") return value.get<double>() >= limit.GetDouble();
    if (name == "maximum") return value.get<double>() <= limit.GetDouble();
    return name != "exclusiveMinimum" || value.get<double>() > limit.GetDouble();
  }
  if (value.is_string()) {
    const auto& text = value.get_ref<const std::string&>();
    if (name == "minLength") return text.size() >= limit.GetUint64();
    return name != "pattern" || matches_name_pattern(text);
  }
  if (!value.is_structured()) return true;
  if (name == (value.is_array() ? "minItems" : "minProperties"))
    return value.size() >= limit.GetUint64();
  if (name == (value.is_array() ? "maxItems" : "maxProperties"))
    return value.size() <= limit.GetUint64();
  if (value.is_array()) return name != "uniqueItems" || has_unique_elements(value);
  if (name == "required") return has_all(value, limit);
  return name != "dependencies" ||
         std::all_of(limit.MemberBegin(), limit.MemberEnd(), [&](const auto& item) {
           return !value.contains(item.name.GetString()) || has_all(value, item.value);
         });
}

/// Compares a document with its schema and records the most deeply nested value that violates a
/// schema rule. Objects and arrays around this value only repeat the violation.
class Checker {
 public:
  explicit Checker(const SchemaRule& root) : root_(root) {}

  bool check(const SchemaRule& stated, const Json& value) {
    const SchemaRule& rule = meant(stated);
    if (const SchemaRule* any = keyword(rule, "anyOf")) return check_any(*any, value);
    const auto obeyed = [&](const auto& item) {
      return obeys(value, {item.name.GetString(), item.name.GetStringLength()}, item.value);
    };
    bool good = has_type(value, rule) && std::all_of(rule.MemberBegin(), rule.MemberEnd(), obeyed);
    const bool good_inside =
        value.is_array() ? check_items(rule, value) : check_members(rule, value, good);
    if (!good) note(rule, value);
    return good_inside && good;
  }

  [[nodiscard]] const BrokenRules& deepest() const { return deepest_; }

 private:
  bool check_any(const SchemaRule& alternatives, const Json& value) {
    const BrokenRules before = deepest_;
    for (const SchemaRule& alternative : alternatives.GetArray()) {
      if (!check(alternative, value)) continue;
      deepest_ = before;
      return true;
    }
    return false;
  }

  /// Returns the rule to which "$ref" refers. The result is cached.
  const SchemaRule& meant(const SchemaRule& stated) {
    const SchemaRule*& rule = meant_[&stated];
    if (rule == nullptr) rule = &resolve_ref(root_, stated);
    return *rule;
  }

  bool check_items(const SchemaRule& rule, const Json& value) {
    const SchemaRule* inner = keyword(rule, "items");
    if (inner == nullptr || !inner->IsObject()) return true;
    bool good = true;
    path_.push_back({nullptr, 0});
    for (const Json& item : value) {
      good &= check(*inner, item);
      ++path_.back().index;
    }
    path_.pop_back();
    return good;
  }

  /// @param known  set to false if a key has no rule and "additionalProperties" is false
  bool check_members(const SchemaRule& rule, const Json& value, bool& known) {
    if (!value.is_object()) return true;
    const SchemaRule* properties = keyword(rule, "properties");
    const SchemaRule* others = keyword(rule, "additionalProperties");
    bool good = true;
    for (const auto& [key, item] : value.get_ref<const Json::object_t&>()) {
      const SchemaRule* own = properties == nullptr ? nullptr : keyword(*properties, key.c_str());
      const SchemaRule* inner = own != nullptr ? own : others;
      known &= inner == nullptr || !inner->IsFalse();
      if (inner == nullptr || !inner->IsObject()) continue;
      path_.push_back({&key, 0});
      good &= check(*inner, item);
      path_.pop_back();
    }
    return good;
  }

  void note(const SchemaRule& rule, const Json& value) {
    if (deepest_.value == nullptr || path_.size() > deepest_.path.size()) {
      deepest_ = {&value, {}, {}};
      for (const Step& step : path_)
        deepest_.path.push_back(step.key != nullptr ? *step.key : std::to_string(step.index));
    }
    if (deepest_.value == &value) deepest_.rules.push_back(&rule);
  }

  /// Step of a JSON pointer: the key of an object's member, or the index of an array's item.
  struct Step {
    const std::string* key = nullptr;
    std::size_t index = 0;
  };
  const SchemaRule& root_;
  std::unordered_map<const SchemaRule*, const SchemaRule*> meant_;
  std::vector<Step> path_;
  BrokenRules deepest_;
};

}  // namespace

std::optional<SchemaFault> find_schema_fault(const Json& document, const std::string& schema) {
  const SchemaRule& root = load_schema(schema);
  Checker checker(root);
  if (checker.check(root, document)) return std::nullopt;
  return describe_violation(root, checker.deepest());
}

}  // namespace trammel::harness
