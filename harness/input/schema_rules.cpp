#include "harness/input/schema_rules.h"

#include <rapidjson/pointer.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <map>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"

namespace trammel::harness {

const SchemaRule* keyword(const SchemaRule& rule, const char* name) {
  const auto found = rule.FindMember(name);
  return found == rule.MemberEnd() ? nullptr : &found->value;
}

const SchemaRule& load_schema(const std::string& name) {
  static std::map<std::string, std::pair<std::string, SchemaDocument>> loaded;
  auto& [text, document] = loaded[name];  // strings of the parsed document point into the text
  if (document.IsNull()) {
    const auto file = data_root() / "cases" / "schema" / (name + ".schema.json");
    // RapidJSON reads aligned blocks of 16 bytes, which may extend beyond the last character.
    text = read_text(file) + std::string(16, '\0');
    if (document.ParseInsitu(text.data()).HasParseError())
      throw InputError(file.string() + ": the schema cannot be parsed; expected JSON");
  }
  return document;
}

const SchemaRule& resolve_ref(const SchemaRule& root, const SchemaRule& rule) {
  const SchemaRule* reference = keyword(rule, "$ref");
  if (reference == nullptr) return rule;
  using Pointer = rapidjson::GenericPointer<SchemaRule, SchemaAllocator>;
  return resolve_ref(root,
                     *Pointer(reference->GetString(), reference->GetStringLength()).Get(root));
}

bool rule_allows_type(const SchemaRule& rule, const char* type) {
  const SchemaRule* stated = keyword(rule, "type");
  if (stated == nullptr) return false;
  const auto is_type = [&](const SchemaRule& value) { return value == type; };
  return stated->IsString() ? is_type(*stated)
                            : std::any_of(stated->Begin(), stated->End(), is_type);
}

namespace {

using Rules = std::vector<const SchemaRule*>;

/// Collects the rules of a schema node after resolving "$ref" and "anyOf".
void open(const SchemaRule& root, const SchemaRule& stated, Rules& rules) {
  const SchemaRule& rule = resolve_ref(root, stated);
  const SchemaRule* any = keyword(rule, "anyOf");
  if (any == nullptr) {
    rules.push_back(&rule);
    return;
  }
  for (const SchemaRule& alternative : any->GetArray()) open(root, alternative, rules);
}

std::size_t count_or_default(const SchemaRule& rule, const char* name, std::size_t otherwise) {
  const SchemaRule* count = keyword(rule, name);
  return count == nullptr ? otherwise : count->GetUint64();
}

std::string limits(const SchemaRule& rule) {
  std::vector<std::string> parts;
  const auto add = [&](const char* key, const char* word) {
    if (const SchemaRule* limit = keyword(rule, key))
      parts.push_back(word + shortest_decimal(limit->GetDouble()));
  };
  add("exclusiveMinimum", "above ");
  add("minimum", "at least ");
  add("maximum", "at most ");
  return parts.empty() ? std::string() : " " + join(parts, "and");
}

std::string describe_rule(const SchemaRule& root, const SchemaRule& rule);

std::string describe_array(const SchemaRule& root, const SchemaRule& rule) {
  std::string text = "an array";
  const std::size_t min_count = count_or_default(rule, "minItems", 0);
  const std::size_t max_count = count_or_default(rule, "maxItems", 0);
  if (min_count > 0 && min_count == max_count) {
    text += " of " + std::to_string(min_count);
  } else if (max_count > 0) {
    text += " of " + std::to_string(min_count) + " to " + std::to_string(max_count);
  } else if (min_count > 0) {
    text += " of at least " + std::to_string(min_count);
  }
  const SchemaRule* items = keyword(rule, "items");
  if (items == nullptr) return text;
  Rules alternatives;
  open(root, *items, alternatives);
  std::vector<std::string> each;
  for (const SchemaRule* item : alternatives) each.push_back(describe_rule(root, *item));
  return text + " (each " + join(each, "or") + ")";
}

std::string describe_choice(const SchemaRule& choice) {
  if (choice.IsString()) return quoted(schema_string(choice));
  using Encoding = rapidjson::UTF8<>;
  using Text = rapidjson::GenericStringBuffer<Encoding, SchemaAllocator>;
  Text text;
  rapidjson::Writer<Text, Encoding, Encoding, SchemaAllocator> writer(text);
  choice.Accept(writer);
  return text.GetString();
}

std::string describe_rule(const SchemaRule& root, const SchemaRule& rule) {
  if (const SchemaRule* choices = keyword(rule, "enum")) {
    std::vector<std::string> values;
    for (const SchemaRule& choice : choices->GetArray()) values.push_back(describe_choice(choice));
    return join(values, "or");
  }
  const char* or_null = rule_allows_type(rule, "null") ? " or null" : "";
  if (rule_allows_type(rule, "integer")) return "a whole number" + limits(rule);
  if (rule_allows_type(rule, "number")) return "a number" + limits(rule) + or_null;
  if (rule_allows_type(rule, "array")) return describe_array(root, rule);
  if (rule_allows_type(rule, "boolean")) return "true or false";
  if (rule_allows_type(rule, "object")) return std::string("an object") + or_null;
  if (!rule_allows_type(rule, "string")) return "something else";
  const bool has_pattern = keyword(rule, "pattern") != nullptr;
  return has_pattern ? "a name of letters, digits, '-', '_' and '.'" : "text";
}

std::string describe_value(const Json& value) {
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array of " + std::to_string(value.size());
  return printable(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// Returns the keys that an object may have; empty if any key is allowed.
std::vector<std::string> allowed_keys(const Rules& rules) {
  std::vector<std::string> keys;
  for (const SchemaRule* rule : rules) {
    const SchemaRule* others = keyword(*rule, "additionalProperties");
    if (others == nullptr || !others->IsFalse()) return {};
    if (const SchemaRule* properties = keyword(*rule, "properties"))
      for (const auto& item : properties->GetObject()) keys.push_back(schema_string(item.name));
  }
  std::ranges::sort(keys);
  return keys;
}

std::string all_quoted(std::vector<std::string> names, const char* last) {
  for (std::string& name : names) name = harness::quoted(name);
  return join(names, last);
}

/// Returns the keys of an object as text for messages: "(got 'a' and 'b')".
std::string list_keys(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  std::ranges::sort(keys);
  return " (got " + (keys.empty() ? "none" : all_quoted(keys, "and")) + ")";
}

std::string join_pointer(const std::vector<std::string>& path) {
  JsonPointer pointer;
  for (const std::string& step : path) pointer /= step;
  return pointer.to_string();
}

/// Returns the required keys of an object, including keys that other keys of the object require.
std::vector<std::string> find_required_keys(const Json& object, const SchemaRule& rule) {
  std::vector<std::string> keys;
  const auto add = [&](const SchemaRule& names) {
    for (const SchemaRule& name : names.GetArray()) keys.push_back(schema_string(name));
  };
  if (const SchemaRule* required = keyword(rule, "required")) add(*required);
  if (const SchemaRule* dependencies = keyword(rule, "dependencies"))
    for (const auto& item : dependencies->GetObject())
      if (object.contains(schema_string(item.name))) add(item.value);
  return keys;
}

SchemaFault explain_object(const Json& object, std::vector<std::string> path, const Rules& rules) {
  const std::vector<std::string> allowed = allowed_keys(rules);
  for (const auto& item : object.items()) {
    const bool known = contains(allowed, item.key());
    if (allowed.empty() || known) continue;
    path.push_back(item.key());
    const std::string guess = did_you_mean(item.key(), allowed);
    return {join_pointer(path),
            "unknown key" + (guess.empty() ? "; expected " + all_quoted(allowed, "or") : guess)};
  }
  std::string wanted = "another object";
  for (const SchemaRule* rule : rules) {
    for (const std::string& key : find_required_keys(object, *rule)) {
      if (object.contains(key)) continue;
      return {join_pointer(path), "expected the key " + quoted(key) + list_keys(object)};
    }
    const std::size_t max_count = count_or_default(*rule, "maxProperties", object.size());
    if (object.size() < count_or_default(*rule, "minProperties", 0) || object.size() > max_count) {
      const std::vector<std::string> needed = find_required_keys(object, *rule);
      std::vector<std::string> others;
      std::set_difference(allowed.begin(), allowed.end(), needed.begin(), needed.end(),
                          std::back_inserter(others));
      const bool one = max_count == needed.size() + 1;
      const std::string count = one ? "exactly one of " : "at least one of ";
      wanted = (allowed.empty() ? "at least one key" : count + all_quoted(others, "or")) +
               list_keys(object) + (one && object.size() > max_count ? "; null removes a key" : "");
    }
  }
  return {join_pointer(path), "expected " + wanted};
}

SchemaFault explain_value(const SchemaRule& root, const BrokenRules& broken) {
  std::vector<std::string> wanted, choices;
  std::string suffix;
  for (const SchemaRule* rule : broken.rules) {
    const std::string text = describe_rule(root, *rule);
    if (!contains(wanted, text)) wanted.push_back(text);
    if (const SchemaRule* stated = keyword(*rule, "enum"))
      for (const SchemaRule& choice : stated->GetArray())
        if (choice.IsString()) choices.push_back(schema_string(choice));
    if (broken.value->is_array() && keyword(*rule, "uniqueItems") != nullptr)
      suffix = " without duplicates";
  }
  if (broken.value->is_string()) suffix = did_you_mean(broken.value->get<std::string>(), choices);
  return {join_pointer(broken.path), "expected " + join(wanted, "or") + " (got " +
                                         describe_value(*broken.value) + ")" + suffix};
}

}  // namespace

SchemaFault describe_violation(const SchemaRule& schema, const BrokenRules& broken) {
  Rules of_objects;
  std::ranges::copy_if(broken.rules, std::back_inserter(of_objects),
                       [](const SchemaRule* rule) { return rule_allows_type(*rule, "object"); });
  if (!broken.value->is_object() || of_objects.empty()) return explain_value(schema, broken);
  return explain_object(*broken.value, broken.path, of_objects);
}

}  // namespace trammel::harness
