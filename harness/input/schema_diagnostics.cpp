#include "harness/input/schema_diagnostics.h"

#include <algorithm>
#include <cmath>

#include "harness/base/text.h"
#include "harness/input/former_names.h"

namespace trammel::harness {
namespace {

using Plain = nlohmann::json;
using Rules = std::vector<const Plain*>;

/// The rules that stand behind a schema node, its references and alternatives opened.
void open(const Plain& root, const Plain& node, Rules& rules) {
  if (!node.is_object()) return;
  if (const auto ref = node.find("$ref"); ref != node.end()) {
    const std::string target = ref->get<std::string>().substr(1);  // "#/definitions/x"
    open(root, root.at(Plain::json_pointer(target)), rules);
    return;
  }
  if (const auto any = node.find("anyOf"); any != node.end()) {
    for (const Plain& alternative : *any) open(root, alternative, rules);
    return;
  }
  rules.push_back(&node);
}

Rules step(const Plain& root, const Rules& rules, const std::string& token) {
  Rules inner;
  for (const Plain* rule : rules) {
    const auto properties = rule->find("properties");
    if (properties != rule->end() && properties->contains(token)) {
      open(root, properties->at(token), inner);
    } else if (rule->contains("items")) {
      open(root, rule->at("items"), inner);
    } else if (rule->contains("additionalProperties")) {
      open(root, rule->at("additionalProperties"), inner);
    }
  }
  return inner;
}

bool wants(const Plain& rule, const char* type) {
  const auto stated = rule.find("type");
  if (stated == rule.end()) return false;
  if (stated->is_string()) return *stated == type;
  return std::find(stated->begin(), stated->end(), type) != stated->end();
}

std::string limits(const Plain& rule) {
  std::vector<std::string> parts;
  const auto add = [&](const char* key, const char* word) {
    if (rule.contains(key)) parts.push_back(word + shortest(rule.at(key).get<double>()));
  };
  add("exclusiveMinimum", "above ");
  add("minimum", "at least ");
  add("maximum", "at most ");
  return parts.empty() ? std::string() : std::string(" ").append(join(parts, "and"));
}

std::string describe_rule(const Plain& root, const Plain& rule);

std::string describe_array(const Plain& root, const Plain& rule) {
  std::string text = "an array";
  const std::size_t min_count = rule.value("minItems", std::size_t{0});
  const std::size_t max_count = rule.value("maxItems", std::size_t{0});
  if (min_count > 0 && min_count == max_count) {
    text += " of " + std::to_string(min_count);
  } else if (max_count > 0) {
    text += " of " + std::to_string(min_count) + " to " + std::to_string(max_count);
  } else if (min_count > 0) {
    text += " of at least " + std::to_string(min_count);
  }
  if (!rule.contains("items")) return text;
  Rules items;
  open(root, rule.at("items"), items);
  std::vector<std::string> each;
  for (const Plain* item : items) each.push_back(describe_rule(root, *item));
  return text + " (each " + join(each, "or") + ")";
}

std::string describe_rule(const Plain& root, const Plain& rule) {
  if (rule.contains("enum")) {
    std::vector<std::string> values;
    for (const Plain& value : rule.at("enum")) {
      values.push_back(value.is_string() ? quoted(value.get<std::string>()) : value.dump());
    }
    return join(values, "or");
  }
  if (wants(rule, "integer")) return "a whole number" + limits(rule);
  if (wants(rule, "number")) {
    return "a number" + limits(rule) + (wants(rule, "null") ? " or null" : "");
  }
  if (wants(rule, "array")) return describe_array(root, rule);
  if (wants(rule, "boolean")) return "true or false";
  if (wants(rule, "object")) return wants(rule, "null") ? "an object or null" : "an object";
  if (wants(rule, "string")) {
    if (rule.contains("pattern")) return "a name of letters, digits, '-', '_' and '.'";
    return "text";
  }
  return "something else";
}

std::string describe(const Plain& value) {
  switch (value.type()) {
    case Plain::value_t::object:
      return "an object";
    case Plain::value_t::array:
      return "an array of " + std::to_string(value.size());
    case Plain::value_t::null:
      return "null";
    default:
      return printable(value.dump(-1, ' ', false, Plain::error_handler_t::replace));
  }
}

std::vector<std::string> keys_of(const Plain& object) {
  std::vector<std::string> keys;
  for (const auto& item : object.items()) keys.push_back(item.key());
  return keys;
}

/// Keys that an object may have; empty when it may have any.
std::vector<std::string> allowed_keys(const Rules& rules) {
  std::vector<std::string> keys;
  for (const Plain* rule : rules) {
    if (!rule->contains("additionalProperties") || rule->at("additionalProperties") != false) {
      return {};
    }
    if (rule->contains("properties")) {
      for (const auto& item : rule->at("properties").items()) keys.push_back(item.key());
    }
  }
  return keys;
}

std::string all_quoted(std::vector<std::string> names, const char* last) {
  for (std::string& name : names) name = harness::quoted(name);
  return join(names, last);
}

/// What stands there instead: "(got 'a' and 'b')".
std::string got_keys(const Plain& object) {
  return " (got " + (object.empty() ? "none" : all_quoted(keys_of(object), "and")) + ")";
}

SchemaError unknown_key(const Plain::json_pointer& pointer, const std::string& key,
                        const std::vector<std::string>& allowed) {
  std::string message = "expected no key of that name";
  std::vector<std::string> path = {key};
  for (auto outer = pointer; !outer.empty(); outer.pop_back()) path.push_back(outer.back());
  std::reverse(path.begin(), path.end());
  const std::string guess = did_you_mean(current_key(path), allowed);
  message += guess.empty() ? " (known here: " + all_quoted(allowed, "and") + ")" : guess;
  return {(pointer / key).to_string(), message};
}

SchemaError explain_object(const Plain::json_pointer& pointer, const Plain& object,
                           const Rules& rules) {
  const std::vector<std::string> allowed = allowed_keys(rules);
  for (const auto& item : object.items()) {
    const bool known = std::find(allowed.begin(), allowed.end(), item.key()) != allowed.end();
    if (!allowed.empty() && !known) return unknown_key(pointer, item.key(), allowed);
  }
  for (const Plain* rule : rules) {
    for (const Plain& key : rule->value("required", Plain::array())) {
      const std::string name = key.get<std::string>();
      if (!object.contains(name)) {
        return {pointer.to_string(), "expected the key '" + name + "'" + got_keys(object)};
      }
    }
  }
  for (const Plain* rule : rules) {
    const std::size_t min_count = rule->value("minProperties", std::size_t{0});
    const std::size_t max_count = rule->value("maxProperties", std::size_t{1000000});
    if (object.size() < min_count || object.size() > max_count) {
      const std::string count = max_count == 1 ? "exactly one of " : "at least one of ";
      return {pointer.to_string(),
              "expected " +
                  (allowed.empty() ? "at least one key" : count + all_quoted(allowed, "or")) +
                  got_keys(object)};
    }
  }
  return {pointer.to_string(), "expected another object"};
}

}  // namespace

SchemaError explain(const Plain& schema, const Plain& document,
                    const std::vector<std::string>& path) {
  Rules rules;
  open(schema, schema, rules);
  const Plain* value = &document;
  Plain::json_pointer pointer;
  for (const std::string& token : path) {
    rules = step(schema, rules, token);
    pointer /= token;
    value = value->is_array() ? &value->at(std::stoul(token)) : &value->at(token);
  }
  Rules of_objects;
  std::copy_if(rules.begin(), rules.end(), std::back_inserter(of_objects),
               [](const Plain* rule) { return wants(*rule, "object"); });
  if (value->is_object() && !of_objects.empty()) {
    return explain_object(pointer, *value, of_objects);
  }
  std::vector<std::string> wanted, choices;
  for (const Plain* rule : rules) {
    const std::string text = describe_rule(schema, *rule);
    if (std::find(wanted.begin(), wanted.end(), text) == wanted.end()) wanted.push_back(text);
    for (const Plain& choice : rule->value("enum", Plain::array())) {
      if (choice.is_string()) choices.push_back(choice.get<std::string>());
    }
  }
  std::string message = "expected " + join(wanted, "or") + " (got " + describe(*value) + ")";
  if (value->is_string()) message += did_you_mean(value->get<std::string>(), choices);
  if (value->is_array()) {
    for (const Plain* rule : rules) {
      if (rule->value("uniqueItems", false)) message += ", none twice";
    }
  }
  return {pointer.to_string(), message};
}

}  // namespace trammel::harness
