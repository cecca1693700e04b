#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <cmath>

#include "harness/base/environment.h"
#include "harness/base/json_file.h"
#include "harness/input/catalogue.h"
#include "harness/studies/cost_study.h"

namespace trammel::fuzz {
namespace {

namespace fs = std::filesystem;
using Random = std::mt19937_64;

std::size_t below(Random& random, std::size_t count) {
  return static_cast<std::size_t>(random() % std::max<std::size_t>(1, count));
}

template <class List>
auto one_of(Random& random, const List& list) {
  return list[below(random, list.size())];
}

/// Returns a text from a JSON document: a key, a text value, a pointer to a value, or the part of a
/// text after a colon.
std::string pick_word(Random& random, const Json& document) {
  static const Json odd =
      Json::parse(R"(["", " ", "x", "..", "/", "~", "-1", "0", "base", "a:b", ":", "../x", "=1+1",
                     "\u0000", "a\nb", "\u001b[31m", "`id`", "%s%n", "\u00e9"])");
  const Json flat = document.flatten();
  if (flat.empty() || below(random, 8) == 0)
    return below(random, 20) == 0 ? std::string(3000, 'n') : one_of(random, odd).get<std::string>();
  const auto item = std::next(flat.begin(), static_cast<long>(below(random, flat.size())));
  JsonPointer pointer(item.key());
  switch (below(random, 4)) {
    case 0:
      for (std::size_t up = below(random, 3); up > 0 && !pointer.empty(); --up) pointer.pop_back();
      return pointer.to_string();
    case 1:
      return pointer.empty() ? "" : pointer.back();
    default:
      if (!item.value().is_string()) return pointer.empty() ? "" : pointer.back();
  }
  const auto text = item.value().get<std::string>();
  const std::size_t colon = text.find(':');
  return colon == std::string::npos || below(random, 2) == 0
             ? text
             : text.substr(0, colon + 1) + (pointer.empty() ? "" : pointer.back());
}

/// Returns a number at or beyond the limits of a schema rule, or a numerically difficult number
/// such as 5e-324.
Json pick_number(Random& random, const Json& rule, const Json& former) {
  static const Json hard = Json::parse(
      R"([0, -0.0, 1, -1, 2, 3, 7, 0.5, 0.99, 1e-9, 1e9, 1e-30, 1e30, 1e100, 1e-300, 1e300, -1e300,
          5e-324, 1.7976931348623157e308, 2147483647, 2147483648, 4294967296, 9007199254740993,
          -9223372036854775808, 18446744073709551615])");
  std::vector<Json> ends;
  for (const char* key : {"minimum", "maximum", "exclusiveMinimum"}) {
    if (!rule.contains(key)) continue;
    const Json& end = rule.at(key);
    const auto number = end.get<double>();
    ends.insert(ends.end(), {end, std::nextafter(number, 1e308), std::nextafter(number, -1e308),
                             number + 1, number - 1});
  }
  if (!ends.empty() && below(random, 2) == 0) return one_of(random, ends);
  if (!former.is_number() || below(random, 2) == 0) return one_of(random, hard);
  const auto number = former.get<double>();
  if (former.is_number_integer() && std::abs(number) < 1e15) {
    const auto whole = former.get<std::int64_t>();
    return one_of(random, std::vector<Json>{whole + 1, whole - 1, -whole, 10 * whole, whole / 2});
  }
  return one_of(random, std::vector<Json>{-number, number * 10, number / 10, number * 1e6,
                                          number / 1e6, std::nextafter(number, 1e308)});
}

/// Returns the merge patch that changes `before` into `after`.
Json merge_patch(const Json& before, const Json& after) {
  if (!before.is_object() || !after.is_object()) return after;
  Json patch = Json::object();
  for (const auto& item : before.items())
    if (!after.contains(item.key())) patch[item.key()] = nullptr;
  for (const auto& item : after.items()) {
    if (!before.contains(item.key())) {
      patch[item.key()] = item.value();
    } else if (before.at(item.key()) != item.value()) {
      patch[item.key()] = merge_patch(before.at(item.key()), item.value());
    }
  }
  return patch;
}

void erase(Json& json, const JsonPointer& at) {
  Json& around = json.at(at.parent_pointer());
  around.is_array() ? around.erase(std::stoul(at.back())) : (void)around.erase(at.back());
}

/// Changes characters of a JSON text, regardless of its structure.
/// @returns a description of the change
std::string disturb_text(Random& random, std::string& text) {
  const std::size_t at = below(random, text.size());
  static const std::vector<std::string> pieces = [] {
    std::vector<std::string> all(1, std::string(1, '\0'));
    all.emplace_back(200, '[');
    for (const char* piece : {"NaN",
                              "1e999",
                              "-Infinity",
                              "0x10",
                              "01",
                              "\"\\ud800\"",
                              "\xff\xfe",
                              "\xef\xbb\xbf",
                              "{",
                              "]",
                              "/**/",
                              ",",
                              "\"a\":1,\"a\":2,",
                              "1e-999",
                              "123456789012345678901234567890",
                              "\xed\xa0\x80",
                              "\"\\u0000\"",
                              "null",
                              "-",
                              "\"",
                              "\\"})
      all.emplace_back(piece);
    return all;
  }();
  switch (below(random, 5)) {
    case 0:
      text.resize(at);
      return "cut to " + std::to_string(at) + " bytes";
    case 1:
      text[at] = static_cast<char>(random());
      return "byte " + std::to_string(at);
    case 2:
      text.insert(at, one_of(random, pieces));
      return "inserted at " + std::to_string(at);
    case 3: {
      const std::size_t digit = text.find_first_of("0123456789", at);
      if (digit != std::string::npos) text.replace(digit, 1, one_of(random, pieces));
      return "replaced at " + std::to_string(digit);
    }
    default: {
      const std::size_t length = 1 + below(random, 200);
      text.insert(below(random, text.size()), text.substr(at, length));
      return "doubled from " + std::to_string(at);
    }
  }
}

}  // namespace

const std::vector<std::string>& Mutator::kinds() {
  static const std::vector<std::string> all = {"case", "cost", "claims", "reference", "results"};
  return all;
}

Mutator::Mutator(const std::vector<Json>& results) {
  for (const std::string& kind : kinds()) schemas_.emplace(kind, kind);
  const harness::Catalogue catalogue;
  for (const fs::path& file : catalogue.runnable_files()) {
    const Json json = harness::read_json(file);
    add("case", file.stem(), json);
    if (!json.contains("extends")) continue;
    Json whole = harness::load_case(file, catalogue).document.value();
    whole.erase("extends");
    add("case", file.stem(), whole);
  }
  for (const fs::path& file : harness::cost_study_files())
    add("cost", file.stem(), harness::read_json(file));
  for (const auto& entry : fs::directory_iterator(harness::data_root() / "cases/paper/claims"))
    add("claims", entry.path().stem(), harness::read_json(entry.path()));
  for (const auto& entry :
       fs::recursive_directory_iterator(harness::data_root() / "references/values"))
    if (entry.path().extension() == ".json")
      add("reference", entry.path().stem(), harness::read_json(entry.path()));
  for (const Json& json : results) add("results", "results", json);
  // Sorting makes the inputs independent of the order in which a system lists directories.
  for (auto& [kind, origins] : origins_)
    std::stable_sort(origins.begin(), origins.end(),
                     [](const Origin& a, const Origin& b) { return a.name < b.name; });
}

void Mutator::add(const std::string& kind, const std::string& name, Json json) {
  auto places = schemas_.at(kind).places(json);
  origins_[kind].push_back({name, std::move(json), std::move(places)});
}

Json Mutator::generate(Random& random, const Schema& schema, const Json& rule, const Json& document,
                       int depth) const {
  if (rule.contains("enum")) return one_of(random, rule.at("enum"));
  const Json type = rule.contains("type") ? rule.at("type") : Json("object");
  const auto name = (type.is_array() ? one_of(random, type) : type).get<std::string>();
  if (name == "string") return pick_word(random, document);
  if (name == "boolean") return below(random, 2) == 0;
  if (name == "null") return nullptr;
  if (name == "number" || name == "integer") {
    return pick_number(random, rule,
                       name == "integer" ? Json(1 + below(random, 4))
                                         : Json(0.1 * static_cast<double>(1 + below(random, 50))));
  }
  const auto entry = [&](const std::string& key) {
    const auto rules = schema.rules_of_entry({&rule}, key);
    return rules.empty() ? Json(pick_word(random, document))
                         : generate(random, schema, *one_of(random, rules), document, depth + 1);
  };
  if (name == "array") {
    Json array = Json::array();
    const std::size_t least = rule.value("minItems", std::size_t{0});
    for (std::size_t i = least + (depth < 3 ? below(random, 2) : 0); i > 0; --i)
      array.push_back(entry("0"));
    return array;
  }
  Json object = Json::object();
  for (const Json& key : rule.value("required", Json::array()))
    object[key.get<std::string>()] = entry(key.get<std::string>());
  const Json properties = rule.value("properties", Json::object());
  for (const auto& item : properties.items())
    if (below(random, 4 + 4 * static_cast<std::size_t>(depth)) == 0)
      object[item.key()] = entry(item.key());
  if (properties.empty() && depth < 5) object[pick_word(random, document)] = entry("");
  return object;
}

/// Changes the document at a random pointer.
void Mutator::change(Random& random, const std::string& kind, Json& json, Input& input) const {
  const Schema& schema = schemas_.at(kind);
  const auto places = schema.places(json);
  const Place place = one_of(random, places);
  const JsonPointer& at = place.at;
  Json& value = json.at(at);
  const Json& rule = place.rules.empty() ? Json::object() : *one_of(random, place.rules);
  const auto note = [&](const std::string& what) {
    input.how += what + ' ' + at.to_string() + "; ";
  };
  switch (at.empty() ? 5 : below(random, 8)) {
    case 0:
      note("erased");
      erase(json, at);
      break;
    case 1:
      note("generated again");
      value = generate(random, schema, rule, json, 0);
      break;
    case 2:
    case 3:
      if (value.is_number())
        value = pick_number(random, rule, value);
      else if (value.is_string())
        value = pick_word(random, json);
      else if (!rule.empty())
        value = generate(random, schema, rule, json, 0);
      note("changed");
      break;
    case 4:
      value = one_of(random, std::vector<Json>{true, nullptr, 7, 0.5, "x", Json::array(),
                                               Json::object(), Json::array({1, 2})});
      note("retyped");
      break;
    case 5: {  // adds a key, which the rule may forbid
      const Json properties = rule.empty() ? json : rule.value("properties", Json::object());
      const std::string key =
          properties.empty() || below(random, 6) == 0
              ? pick_word(random, json)
              : std::next(properties.begin(), static_cast<long>(below(random, properties.size())))
                    .key();
      const auto rules =
          schema.rules_of_entry(at.empty() ? std::vector{&schema.root()} : place.rules, key);
      const Json entry =
          rules.empty() ? Json(1) : generate(random, schema, *one_of(random, rules), json, 0);
      if (value.is_object()) value[key] = entry;
      if (value.is_array())
        value.push_back(value.empty() || below(random, 2) == 0 ? entry : value[0]);
      note("added '" + key + "' to");
      break;
    }
    default: {  // copies a value with the same rules from another file
      const Origin& other = origins_.at(kind)[below(random, origins_.at(kind).size())];
      std::vector<const Place*> alike;
      for (const Place& candidate : other.places)
        if (!candidate.rules.empty() && candidate.rules == place.rules) alike.push_back(&candidate);
      if (!alike.empty()) value = other.json.at(one_of(random, alike)->at);
      note("copied from " + other.name + " to");
    }
  }
  // The input is invalid if the new value breaks its schema rule. If the value was erased, the
  // input is invalid if the object that contained the value now breaks the rule of this object.
  if (!place.is_certain || json.contains("extends")) return;
  const Json found = json.value(at, Json());
  const bool erased = !json.contains(at);
  const auto around = std::find_if(places.begin(), places.end(), [&](const Place& candidate) {
    return !at.empty() && candidate.at == at.parent_pointer();
  });
  const bool is_wrong =
      !erased && !found.is_null() && !place.rules.empty() && forbids(*place.rules[0], found);
  const bool misses = erased && around != places.end() && !around->rules.empty() &&
                      forbids(*around->rules[0], json.at(around->at));
  input.is_invalid = is_wrong || misses;
}

Input Mutator::make(std::uint32_t seed, std::uint32_t number, const std::string& kind) const {
  std::seed_seq sequence{seed, number};
  Random random(sequence);
  Input input;
  const std::size_t draw = below(random, 20);
  input.kind = !kind.empty() ? kind : kinds()[draw < 16 ? 0 : draw - 15];
  const Origin& origin = origins_.at(input.kind)[below(random, origins_.at(input.kind).size())];
  input.name = origin.name;
  input.pick = below(random, 1000);
  Json json = origin.json;
  const bool as_variant = input.kind == "case" && below(random, 5) == 0;
  constexpr std::size_t kMostChanges = 3;
  const std::size_t changes =
      below(random, 20) == 0 ? 0 : 1 + below(random, 2) * below(random, kMostChanges);
  for (std::size_t i = 0; i < changes; ++i) change(random, input.kind, json, input);
  if (changes > 1) input.is_invalid = false;  // a second change may repair an invalid value
  if (as_variant) {
    Json patch = merge_patch(origin.json, json);
    json = origin.json;
    if (!patch.is_object()) patch = Json::object();
    patch["title"] = "as a variant";
    json["variants"]["fuzz"] = patch;
    input.is_invalid = false;
    input.how += "as a variant; ";
  }
  input.text = json.dump(1, ' ', false, Json::error_handler_t::replace);
  if (below(random, 10) == 0) {
    input.is_invalid = false;
    input.how += disturb_text(random, input.text);
  }
  return input;
}

}  // namespace trammel::fuzz
