#include "harness/input/schema.h"

#include <algorithm>
#include <cctype>

#include "harness/input/schema_diagnostics.h"
#include "harness/input/schema_rules.h"

namespace trammel::harness {
namespace {

/// Where a value stands: the way back to the root, on the stack while the value is checked.
struct Place {
  const Place* parent = nullptr;
  std::string_view key;
  std::size_t index = 0;
  std::size_t depth = 0;

  [[nodiscard]] JsonPointer pointer() const {
    if (parent == nullptr) return JsonPointer();
    return key.data() == nullptr ? parent->pointer() / index : parent->pointer() / std::string(key);
  }
};

bool has_type(const Json& value, const SchemaRule& type) {
  return (value.is_object() && type == "object") || (value.is_array() && type == "array") ||
         (value.is_string() && type == "string") || (value.is_number() && type == "number") ||
         (value.is_number_integer() && type == "integer") ||
         (value.is_boolean() && type == "boolean") || (value.is_null() && type == "null");
}

bool equals(const Json& value, const SchemaRule& choice) {
  if (value.is_string()) {
    return choice.IsString() && value.get_ref<const std::string&>() == text_of(choice);
  }
  return value.is_number() && choice.IsNumber() && value.get<double>() == choice.GetDouble();
}

bool number_obeys(const Json& value, const std::string& name, const SchemaRule& limit) {
  const double number = value.get<double>();
  if (name == "minimum") return number >= limit.GetDouble();
  if (name == "maximum") return number <= limit.GetDouble();
  return name != "exclusiveMinimum" || number > limit.GetDouble();
}

/// The one pattern of the schemas, ^[A-Za-z0-9][A-Za-z0-9._-]*$, by hand: to compile it as a
/// std::regex takes seven million instructions.
bool matches_name_pattern(const std::string& text) {
  const auto plain = [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; };
  return !text.empty() && plain(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
    return plain(c) || c == '.' || c == '_' || c == '-';
  });
}

bool string_obeys(const Json& value, const std::string& name, const SchemaRule& limit) {
  const auto& text = value.get_ref<const std::string&>();
  if (name == "minLength") return text.size() >= limit.GetUint64();
  return name != "pattern" || matches_name_pattern(text);
}

bool array_obeys(const Json& value, const std::string& name, const SchemaRule& limit) {
  if (name == "minItems") return value.size() >= limit.GetUint64();
  if (name == "maxItems") return value.size() <= limit.GetUint64();
  if (name != "uniqueItems" || !limit.GetBool()) return true;
  for (auto item = value.begin(); item != value.end(); ++item) {
    if (std::find(value.begin(), item, *item) != item) return false;
  }
  return true;
}

bool object_obeys(const Json& value, const std::string& name, const SchemaRule& limit) {
  if (name == "minProperties") return value.size() >= limit.GetUint64();
  if (name == "maxProperties") return value.size() <= limit.GetUint64();
  return name != "required" || std::all_of(limit.Begin(), limit.End(), [&](const SchemaRule& key) {
           return value.contains(key.GetString());
         });
}

/// Whether a value obeys one keyword, what is inside the value left out.
bool obeys(const Json& value, const std::string& name, const SchemaRule& limit) {
  if (name == "type" && limit.IsArray()) {
    return std::any_of(limit.Begin(), limit.End(),
                       [&](const SchemaRule& type) { return has_type(value, type); });
  }
  if (name == "type") return has_type(value, limit);
  if (name == "enum") {
    return std::any_of(limit.Begin(), limit.End(),
                       [&](const SchemaRule& choice) { return equals(value, choice); });
  }
  if (value.is_number()) return number_obeys(value, name, limit);
  if (value.is_string()) return string_obeys(value, name, limit);
  if (value.is_array()) return array_obeys(value, name, limit);
  return !value.is_object() || object_obeys(value, name, limit);
}

/// Walks through a document and its schema side by side, and keeps the deepest value that breaks
/// its rules: it is the cause, those around it only repeat that something inside is wrong.
class Checker {
 public:
  explicit Checker(const SchemaRule& root) : root_(root) {}

  bool check(const SchemaRule& stated, const Json& value, const Place& place) {
    const SchemaRule& rule = resolved(root_, stated);
    if (const SchemaRule* any = keyword(rule, "anyOf")) return check_any(*any, value, place);
    bool good = true;
    for (const auto& item : rule.GetObject()) {
      good = good && obeys(value, item.name.GetString(), item.value);
    }
    const bool entries_good = value.is_object()  ? check_members(rule, value, place, good)
                              : value.is_array() ? check_items(rule, value, place)
                                                 : true;
    if (!good) note(rule, value, place);
    return good && entries_good;
  }

  [[nodiscard]] const BrokenRules& deepest() const { return deepest_; }

 private:
  bool check_any(const SchemaRule& alternatives, const Json& value, const Place& place) {
    const BrokenRules before = deepest_;
    const std::size_t depth_before = depth_;
    for (const SchemaRule& alternative : alternatives.GetArray()) {
      if (!check(alternative, value, place)) continue;
      deepest_ = before;
      depth_ = depth_before;
      return true;
    }
    return false;
  }

  /// @param good  becomes false at a key that the object must not have
  bool check_members(const SchemaRule& rule, const Json& value, const Place& place, bool& good) {
    const SchemaRule* properties = keyword(rule, "properties");
    const SchemaRule* others = keyword(rule, "additionalProperties");
    bool members_good = true;
    for (const auto& item : value.items()) {
      const SchemaRule* inner =
          properties == nullptr ? nullptr : keyword(*properties, item.key().c_str());
      if (inner == nullptr) inner = others;
      if (inner == nullptr) continue;
      if (inner->IsBool()) {
        good = good && inner->GetBool();
      } else {
        members_good &= check(*inner, item.value(), {&place, item.key(), 0, place.depth + 1});
      }
    }
    return members_good;
  }

  bool check_items(const SchemaRule& rule, const Json& value, const Place& place) {
    const SchemaRule* items = keyword(rule, "items");
    bool good = true;
    for (std::size_t i = 0; items != nullptr && i < value.size(); ++i) {
      good &= check(*items, value[i], {&place, {}, i, place.depth + 1});
    }
    return good;
  }

  void note(const SchemaRule& rule, const Json& value, const Place& place) {
    if (deepest_.value == nullptr || place.depth > depth_) {
      deepest_ = {&value, place.pointer(), {}};
      depth_ = place.depth;
    }
    if (deepest_.value == &value) deepest_.rules.push_back(&rule);
  }

  const SchemaRule& root_;
  BrokenRules deepest_;
  std::size_t depth_ = 0;
};

}  // namespace

std::optional<SchemaError> find_schema_error(const Json& document, const std::string& schema) {
  const SchemaRule& root = load_schema(schema);
  Checker checker(root);
  if (checker.check(root, document, {})) return std::nullopt;
  return explain(root, checker.deepest());
}

}  // namespace trammel::harness
