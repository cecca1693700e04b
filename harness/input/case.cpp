#include "harness/input/case.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>
#include <set>
#include <tuple>

#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/input/document.h"
#include "harness/input/json_view.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

/// Returns the part of an extended case that the extending case inherits: the keys that define the
/// computation, without checks.
Json select_inherited_keys(const Json& base) {
  Json inherited_keys = Json::object();
  for (const char* key : {"model", "analysis", "effects", "variants", "sweeps", "uncertainty"})
    if (base.contains(key)) inherited_keys[key] = base.at(key);
  if (!inherited_keys.contains("variants") || !inherited_keys["variants"].is_object())
    return inherited_keys;
  for (auto& variant : inherited_keys["variants"]) {
    if (!variant.is_object()) continue;
    variant.erase("checks");
    variant.erase("sweeps");
    variant.erase("expect_status");
  }
  return inherited_keys;
}

/// Applies the extended cases in the order of inheritance, from the root to the direct parent, and
/// then the case file itself.
void apply_with_extended_cases(Document& document, const fs::path& file, const Catalogue& catalogue,
                               std::vector<fs::path> seen) {
  const Json json = read_json(file);
  if (!json.is_object()) throw InputError(file.string(), "", "expected a JSON object of a case");
  seen.push_back(fs::weakly_canonical(file));
  if (const auto extends = json.find("extends"); extends != json.end()) {
    if (!extends->is_string())
      throw InputError(file.string(), "/extends", "expected the name or the file of a case");
    const fs::path base = catalogue.find_base_case(extends->get<std::string>(), file);
    if (contains(seen, fs::weakly_canonical(base)))
      throw InputError(file.string(), "/extends",
                       "the case extends itself, directly or through other cases; expected a case "
                       "that does not extend this case");
    apply_with_extended_cases(document, base, catalogue, seen);
  }
  const bool outermost = seen.size() == 1;
  document.apply_patch(file.string(), "", outermost ? json : select_inherited_keys(json));
}

void validate_variant_names(const Case& given) {
  const JsonView root(given.document);
  for (const auto& [name, variant] : root.entries("variants"))
    if (name == kBaseVariant)
      throw variant.error("the name 'base' denotes the case without patch; expected another name");
}

/// Requires that each indicator of the key "stress_suite" is the name of a check of the case.
void require_checks_of_indicators(const Case& given) {
  const JsonView root(given.document);
  if (!root.has("stress_suite")) return;
  std::vector<std::string> names;
  for (const auto& entry : root.entries("checks")) names.push_back(entry.first);
  for (const auto& [number, place] : root["stress_suite"]["indicators"].entries()) {
    const auto name = place.get<std::string>();
    if (contains(names, name)) continue;
    throw place.error(unknown_name_message("the name of a check of the case", name, names));
  }
}

InputError invalid_pointer_error(const JsonView& pointer, const std::string& guess) {
  return pointer.error("expected a pointer to a value of the case, such as /model/elements (got '" +
                       printable(pointer.get<std::string>()) + "')" + guess);
}

/// Returns the schema violation caused by adding a key at a JSON pointer; empty if the key is
/// allowed. Optional keys with a default value, such as /model/elements, are allowed.
std::optional<SchemaFault> schema_error_of_new_key(const Json& document, const JsonPointer& pointer,
                                                   const Json& value) {
  const SchemaFault nowhere{pointer.to_string(), ""};
  if (pointer.empty() || !document.contains(pointer.parent_pointer())) return nowhere;
  if (!document.at(pointer.parent_pointer()).is_object()) return nowhere;
  Json probe = document;
  probe[pointer] = value;
  const auto schema_error = find_schema_fault(probe, "case");
  return schema_error && schema_error->pointer == pointer.to_string() ? schema_error : std::nullopt;
}

/// @throws InputError  if the pointer leads neither to a value nor to a key that may be added
void require_settable_key(const Document& document, const JsonView& pointer, const Json& value) {
  const auto text = pointer.get<std::string>();
  try {
    const JsonPointer place(text);
    if (!place.empty() && document.value().contains(place)) return;
    const auto schema_error = schema_error_of_new_key(document.value(), place, value);
    if (!schema_error) return;
    const auto guess = schema_error->message.find("; did you mean");
    throw invalid_pointer_error(
        pointer, guess == std::string::npos ? "" : schema_error->message.substr(guess));
  } catch (const Json::exception&) {
    throw invalid_pointer_error(pointer, "");
  }
}

Json patch_setting_pointers(const JsonView& sweep, const Document& document, const Json& value) {
  Json patch = Json::object();
  for (const auto& [number, at] : sweep["pointers"].entries()) {
    require_settable_key(document, at, value);
    patch.merge_patch(patch_setting_value(document.value(), at.get<std::string>(), value));
  }
  return patch;
}

}  // namespace

std::vector<std::string> Case::labels() const {
  return document.value().value("labels", std::vector<std::string>{});
}

std::vector<std::string> Case::variants() const {
  std::vector<std::string> names = {kBaseVariant};
  if (document.value().contains("variants"))
    for (const auto& item : document.value().at("variants").items()) names.push_back(item.key());
  return names;
}

std::string Case::variant_title(const std::string& variant) const {
  if (variant == kBaseVariant) return "Base case";
  return document.value().at("variants").at(variant).value("title", variant);
}

namespace {

/// Adds a default time step and error control to a motion analysis that states no time step. The
/// error control is omitted if all steps must be equal: in modal superposition, extrapolation, and
/// elastodynamics with "effects", which may select large displacement.
/// @throws InputError  if a sweep or a study varies a time step that the case does not state.
void add_default_steps(Document& document) {
  const Json& json = document.value();
  const Json control = {{"error_control", {{"relative", 1e-4}}}};
  for (const auto& [kind, duration, tolerance] :
       {std::tuple("large-motion", "end_time_s", Json{{"tolerance", 1e-6}}),
        std::tuple("transient", "duration_s", control),
        std::tuple("elastodynamics", "duration_s", control)}) {
    for (const char* root : {"/analysis", "/analysis/study/analysis"}) {
      const JsonPointer place = JsonPointer(root) / kind;
      if (!json.contains(place) || json.at(place).contains("step_s")) continue;
      const Json& motion = json.at(place);
      const std::string text = json.value("sweeps", Json()).dump() + json["analysis"].dump();
      if (std::regex_search(text, std::regex("[/\"]step_s\"")))
        throw document.error(place.to_string(),
                             "expected the key 'step_s', because a sweep or study varies it");
      const bool has_equal_steps =
          motion.value("modal_superposition", false) || motion.value("extrapolated", false) ||
          motion.value("method", Json()) == "modal-superposition" ||
          (json.contains("effects") && kind == std::string("elastodynamics"));
      Json patch = Json::object();
      patch[place] =
          has_equal_steps || motion.contains(tolerance.begin().key()) ? Json::object() : tolerance;
      if (motion.contains(duration)) {
        const double step = kDefaultStep * motion[duration].get<double>();
        patch[place]["step_s"] = step;
        if (duration == std::string("end_time_s") && !motion.contains("output_step_s"))
          patch[place]["output_step_s"] = step;
      }
      document.apply_patch(document.origin("").file, "", patch);
    }
  }
}

}  // namespace

Case load_case(const fs::path& file) {
  return load_case(file, Catalogue());
}

Case load_case(const fs::path& file, const Catalogue& catalogue) {
  Case loaded;
  loaded.file = file;
  apply_with_extended_cases(loaded.document, file, catalogue, {});
  loaded.document.validate("case");
  validate_variant_names(loaded);
  require_checks_of_indicators(loaded);
  return loaded;
}

Document patched(const Case& given, const std::string& variant) {
  Document document = given.document;
  const std::string file = given.file.string();
  document.apply_patch(file, "", Json{{"description", nullptr}, {"variants", nullptr}});
  if (variant != kBaseVariant) {
    const std::vector<std::string> names = given.variants();
    if (!contains(names, variant))
      throw InputError(file, "/variants",
                       unknown_name_message("the name of a variant", variant, names));
    Json patch = given.document.value().at("variants").at(variant);
    patch.erase("title");
    const Origin written = given.document.origin((JsonPointer("/variants") / variant).to_string());
    document.apply_patch(written.file, written.pointer, patch);
    document.validate("case");  // load_case has already validated the case itself
  }
  add_default_steps(document);
  return document;
}

void require_pointer(const Document& document, const JsonView& pointer) {
  const auto text = pointer.get<std::string>();
  bool found = false;
  try {
    found = document.value().contains(JsonPointer(text));
  } catch (const Json::exception&) {
    found = false;
  }
  if (!found || text.empty()) throw invalid_pointer_error(pointer, "");
}

Json patch_setting_value(const Json& document, const std::string& pointer, const Json& value) {
  // Builds the patch from the inside out. A patch replaces complete arrays, so an item is set in a
  // copy of its array.
  Json nested = value;
  for (JsonPointer place(pointer); !place.empty(); place.pop_back()) {
    const Json& around = document.at(place.parent_pointer());
    Json outer = around.is_array() ? around : Json::object();
    if (around.is_array()) {
      outer.at(std::stoul(place.back())) = nested;
    } else {
      outer[place.back()] = nested;
    }
    nested = std::move(outer);
  }
  return nested;
}

std::vector<Level> sweep_levels(const Document& variant, const std::string& sweep_name) {
  return sweep_levels(variant, JsonView(variant)["sweeps"][sweep_name]);
}

std::vector<Level> sweep_levels(const Document& variant, const JsonView& sweep) {
  const JsonView values = sweep["values"];
  const bool by_patches = sweep.has("patches");
  if (by_patches == sweep.has("pointers"))
    throw sweep.error("expected exactly one of 'pointers' and 'patches' (got both or neither)");
  if (by_patches && sweep["patches"].size() != values.size())
    throw sweep["patches"].error("expected one patch for each of the " +
                                 std::to_string(values.size()) + " values (got " +
                                 std::to_string(sweep["patches"].size()) + " patches)");
  std::vector<Level> found;
  for (std::size_t i = 0; i < values.size(); ++i) {
    Level level{values[i].get<double>(), variant};
    const Json patch = by_patches ? sweep["patches"][i].json()
                                  : patch_setting_pointers(sweep, variant, values[i].json());
    const JsonView place = by_patches ? sweep["patches"][i] : values[i];
    const Origin written = sweep.document().origin(place.pointer());
    if (by_patches) {
      level.document.apply_patch(written.file, written.pointer, patch);
    } else {
      level.document.apply_value_patch(written.file, written.pointer, patch);
    }
    level.document.validate("case");
    found.push_back(std::move(level));
  }
  return found;
}

namespace {

using Lengths = std::set<std::pair<double, std::string>>;  // lengths [m] with their JSON pointers

/// Warns about the largest length if it is more than a hundred times the second largest length.
void warn_of_millimeters(const Lengths& lengths, std::vector<std::string>& warnings) {
  if (lengths.size() < 2) return;
  const auto& [largest, place] = *lengths.rbegin();
  const double next = std::next(lengths.rbegin())->first;
  if (next > 0 && largest > 100 * next)
    warnings.push_back(place + " is " + shortest_decimal(largest) +
                       " m, more than 100 times all other lengths; is the number in millimeters?");
}

}  // namespace

std::vector<std::string> unit_warnings(const Document& document) {
  std::vector<std::string> warnings;
  const Json model = document.value().value("model", Json::object()), parts = model.flatten();
  for (const auto& [place, value] : parts.items()) {
    const bool is_angle = place.ends_with("_rad") && !place.ends_with("per_rad");
    if (is_angle && value.is_number() && std::abs(value.get<double>()) > 2 * std::numbers::pi)
      warnings.push_back("/model" + place + " is " + shortest_decimal(value.get<double>()) +
                         " rad, more than a full turn; is the number in degrees?");
  }
  Lengths nodes, links;
  const Json members = model.value("members", Json::object());
  const Json points = model.value("nodes", Json::object());
  for (const auto& [name, member] : members.items())
    for (const Json& node : member.value("nodes", Json::array())) {
      const auto end = node.get<std::string>();
      const Json point = points.value(end, Json::array({0, 0}));
      nodes.emplace(std::max(std::abs(point[0].get<double>()), std::abs(point[1].get<double>())),
                    "/model/nodes/" + end);
    }
  if (nodes.size() > 2) warn_of_millimeters(nodes, warnings);
  for (const char* key :
       {"base_side_m", "links/proximal_length_m", "links/distal_length_m", "platform/side_m"}) {
    const JsonPointer place("/manipulator/" + std::string(key));
    if (!model.contains(place)) continue;
    const Json& value = model.at(place);
    for (const Json& length : value.is_array() ? value : Json::array({value}))
      links.emplace(length.get<double>(), "/model" + place.to_string());
  }
  warn_of_millimeters(links, warnings);
  const Json depth = model.value(JsonPointer("/manipulator/links/thickness_m"), Json());
  if (depth.is_number() && !links.empty() && depth.get<double>() > links.begin()->first)
    warnings.push_back("/model/manipulator/links/thickness_m exceeds a length; in millimeters?");
  return warnings;
}

}  // namespace trammel::harness
