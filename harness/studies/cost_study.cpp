#include "harness/studies/cost_study.h"

#include <algorithm>

#include "harness/base/environment.h"
#include "harness/base/find_or_add.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/base/statistic.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

std::vector<double> exact_values(const JsonView& place, const std::string& quantity,
                                 const References& references) {
  const JsonView id = place["reference"];
  const references::Reference& reference = references.get(id);
  if (reference.unit != unit_of(quantity))
    throw id.error("expected a reference in " + unit_of(quantity) + " (got " + reference.unit +
                   ")");
  const std::vector<std::size_t> chosen = place.indices("reference_index");
  if (chosen.empty()) return reference.values;
  std::vector<double> values;
  for (const std::size_t i : chosen) {
    if (i >= reference.values.size())
      throw place["reference_index"].error("expected indices of reference values below " +
                                           std::to_string(reference.values.size()));
    values.push_back(reference.values[i]);
  }
  return values;
}

/// Returns the index of the output to which a quantity of a cost study belongs.
std::size_t index_of_output(const JsonView& study, const JsonView& place) {
  if (!place.has("output")) return 0;
  std::size_t number = 0;
  if (const auto outputs = study.find("outputs"))
    for (const auto& entry : outputs->entries()) {
      if (entry.first == place.text("output")) return number;
      ++number;
    }
  throw place["output"].error("expected one of the 'outputs' of the study");
}

std::vector<ObservedQuantity> read_quantities(const JsonView& study, const JsonView& quantities,
                                              const References& references) {
  std::vector<ObservedQuantity> observed;
  for (const auto& [name, place] : quantities.entries()) {
    ObservedQuantity entry;
    entry.quantity = name;
    entry.addend = place.get<std::string>("plus_quantity", "");
    entry.statistic = place.get<std::string>("statistic", "");
    entry.index = place.indices("index");
    entry.is_error = place.get("is_error", false);
    entry.output = index_of_output(study, place);
    if (place.has("reference")) entry.exact = exact_values(place, name, references);
    observed.push_back(std::move(entry));
  }
  return observed;
}

/// Loads the case of a cost study or of one of its curves. Paths are relative to the study's file.
Document open_case(const JsonView& study, const JsonView& part) {
  const JsonView name = part.has("case") ? part["case"] : study["case"];
  const Origin written = study.document().origin(name.pointer());
  Case given;
  try {
    const Catalogue catalogue;
    given = load_case(catalogue.find_base_case(name.get<std::string>(), written.file), catalogue);
  } catch (const InputError& error) {
    throw name.error(error.what());
  }
  // A curve with another case starts from the base variant of that case.
  const bool own = part.has("case");
  const std::string fallback = own ? kBaseVariant : study.get<std::string>("variant", kBaseVariant);
  return patched(given, part.get<std::string>("variant", fallback));
}

void apply_patch(Document& document, const JsonView& patch) {
  const Origin written = patch.document().origin(patch.pointer());
  document.apply_patch(written.file, written.pointer, patch.json());
}

/// Returns the case of a curve or of the reference solution, with the patches of the study and the
/// curve.
Document patched_study_case(const JsonView& study, const JsonView& part) {
  Document document = open_case(study, part);
  if (study.has("patch") && !part.has("case")) apply_patch(document, study["patch"]);
  if (part.has("patch")) apply_patch(document, part["patch"]);
  return document;
}

/// Inserts a value into a title: "{} elements a link" becomes "4 elements a link", or "1 element a
/// link".
std::string named(const std::string& each, double value) {
  const std::size_t at = each.find("{}");
  if (at == std::string::npos) return each + " " + shortest_decimal(value);
  std::string after = each.substr(at + 2);
  const std::size_t end = std::min(after.find(' ', 1), after.size());
  if (value == 1 && end > 1 && after[end - 1] == 's') after.erase(end - 1, 1);
  return each.substr(0, at) + shortest_decimal(value) + after;
}

bool is_swept(const JsonView& curve, double value, SweepExtent extent) {
  if (extent == SweepExtent::full || !curve.has("quick_values")) return true;
  const auto quick = curve["quick_values"].get<std::vector<double>>();
  return contains(quick, value);
}

void validate_quick_values(const JsonView& curve) {
  if (!curve.has("quick_values") || !curve.has("values")) return;
  const auto values = curve["values"].get<std::vector<double>>();
  for (const auto& entry : curve["quick_values"].entries())
    if (!contains(values, entry.second.get<double>()))
      throw entry.second.error("expected one of the 'values' of this curve");
}

std::vector<Setting> read_curve(const JsonView& study, const std::string& name,
                                const JsonView& curve, SweepExtent extent,
                                const References& references) {
  validate_quick_values(curve);
  Setting setting;
  setting.curve = name;
  setting.curve_title = setting.title = curve.text("title");
  const JsonView quantities = curve.has("quantities") ? curve["quantities"] : study["quantities"];
  setting.observed = read_quantities(study, quantities, references);
  const Document start = patched_study_case(study, curve);
  std::vector<Setting> settings;
  if (!curve.has("values")) {
    if (curve.has("pointers") || curve.has("patches"))
      throw curve.error("'pointers' and 'patches' require 'values'");
    const bool left_out = extent == SweepExtent::quick && curve.has("quick_values");
    if (left_out) return {};
    setting.document = start;
    setting.document.validate("case");
    settings.push_back(std::move(setting));
    return settings;
  }
  for (Level& level : sweep_levels(start, curve)) {
    if (!is_swept(curve, level.parameter, extent)) continue;
    Setting& added = settings.emplace_back(setting);
    added.value = level.parameter;
    added.title += ", " + named(curve.get<std::string>("value_title", "{}"), level.parameter);
    added.document = std::move(level.document);
  }
  return settings;
}

std::size_t find_baseline_setting(const JsonView& place, const std::vector<Setting>& settings) {
  const auto found = std::ranges::find_if(settings, [&](const Setting& setting) {
    const bool same_value = setting.value.has_value() == place.has("value") &&
                            (!setting.value.has_value() || *setting.value == place.number("value"));
    return setting.curve == place.text("curve") && same_value;
  });
  if (found == settings.end())
    throw place.error("no setting has this curve and value (see 'quick_values')");
  return static_cast<std::size_t>(found - settings.begin());
}

/// Reads the divisor (scale) that makes the errors of a study output relative. Returns the scale
/// and its description.
std::pair<Scale, std::string> read_scale(const JsonView& output) {
  const auto place = output.find("scale");
  if (place && place->json().is_object()) {
    const double number = place->number("value");
    return {{Scale::Kind::number, number},
            "relative to " + shortest_decimal(number) + ", " + place->text("why")};
  }
  if (place && place->json() == "largest")
    return {{Scale::Kind::largest, 0}, "relative to the largest of all true values"};
  return {{}, "relative to each true value"};
}

/// Requires that all quantities with a common scale have the same unit.
void require_one_unit_of_scale(const Scale& scale, std::size_t output, const JsonView& study) {
  if (scale.kind == Scale::Kind::entry) return;
  std::string unit;
  for (const auto& [name, place] : study["quantities"].entries()) {
    if (index_of_output(study, place) != output) continue;
    if (unit.empty()) unit = unit_of(name);
    if (unit_of(name) != unit) throw place.error("a common 'scale' requires equal units");
  }
}

std::vector<StudyOutput> read_outputs(const JsonView& study) {
  const auto read = [&](const JsonView& place, std::size_t number, const std::string& title) {
    const auto [scale, description] = read_scale(place);
    require_one_unit_of_scale(scale, number, study);
    return StudyOutput{title, scale, description};
  };
  const auto several = study.find("outputs");
  if (!several) return {read(study, 0, "")};
  if (study.has("scale")) throw study["scale"].error("each of 'outputs' requires its scale");
  std::vector<StudyOutput> outputs;
  for (const auto& entry : several->entries())
    outputs.push_back(read(entry.second, outputs.size(), entry.second.text("title")));
  return outputs;
}

std::string references_of(const JsonView& quantities) {
  std::vector<std::string> names;
  for (const auto& entry : quantities.entries()) {
    if (!entry.second.has("reference")) continue;
    const auto name = entry.second.text("reference");
    if (!contains(names, name)) names.push_back(name);
  }
  return join(names, "and");
}

void read_reference_solution(const JsonView& root, CostStudy& study, const References& references) {
  const std::vector<ObservedQuantity>& wanted = study.settings.front().observed;
  const bool needed = std::ranges::any_of(
      wanted, [](const ObservedQuantity& entry) { return entry.needs_reference_solution(); });
  if (needed != root.has("reference_solution"))
    throw root.error(needed ? "expected 'reference_solution', or a reference for each quantity"
                            : "'reference_solution' excludes references of quantities");
  if (!needed) {
    const std::string named = references_of(root["quantities"]);
    study.reference_description =
        named.empty() ? "exact values with which the analysis computes its errors" : named;
    return;
  }
  const JsonView place = root["reference_solution"];
  Setting reference_solution;
  reference_solution.title = study.reference_description = place.text("title");
  const JsonView quantities = place.has("quantities") ? place["quantities"] : root["quantities"];
  reference_solution.observed = read_quantities(root, quantities, references);
  reference_solution.document = patched_study_case(root, place);
  reference_solution.document.validate("case");
  study.reference_solution = std::move(reference_solution);
}

std::size_t quantity_count(const Setting& setting, std::size_t output) {
  return static_cast<std::size_t>(std::ranges::count_if(
      setting.observed, [output](const ObservedQuantity& one) { return one.output == output; }));
}

void validate_quantity_counts(const JsonView& root, const CostStudy& study) {
  const auto names = root["quantities"];
  for (std::size_t k = 0; k < study.outputs.size(); ++k) {
    std::size_t wanted = 0;
    for (const auto& entry : names.entries()) wanted += index_of_output(root, entry.second) == k;
    const std::string expected = "expected " + std::to_string(wanted) + " quantities" +
                                 (k > 0 ? " of '" + study.outputs[k].title + "', or none" : "");
    if (wanted == 0) throw names.error("no quantity of output '" + study.outputs[k].title + "'");
    for (const Setting& setting : study.settings) {
      const std::size_t given = quantity_count(setting, k);
      if (given != wanted && (k == 0 || given > 0))
        throw root["curves"][setting.curve].error(expected);
    }
    if (study.reference_solution && quantity_count(*study.reference_solution, k) != wanted)
      throw root["reference_solution"].error(expected);
  }
}

[[noreturn]] void wrong_length(const std::string& quantity, std::size_t wanted, std::size_t got) {
  throw std::runtime_error("expected " + std::to_string(wanted) + " values of " + quantity +
                           " (got " + std::to_string(got) + ")");
}

const std::vector<double>& values_of(const Quantities& quantities, const std::string& name) {
  const auto found = quantities.find(name);
  if (found == quantities.end()) {
    std::vector<std::string> names;
    for (const auto& item : quantities) names.push_back(item.first);
    throw std::runtime_error(
        unknown_name_message("a quantity that the computation returns", name, names));
  }
  return found->second.values;
}

}  // namespace

Observations extract_observations(const Quantities& quantities,
                                  const std::vector<ObservedQuantity>& observed) {
  Observations all;
  for (const ObservedQuantity& entry : observed) {
    std::vector<double> values = values_of(quantities, entry.quantity);
    if (!entry.addend.empty()) {
      const std::vector<double>& more = values_of(quantities, entry.addend);
      if (more.size() != values.size()) wrong_length(entry.addend, values.size(), more.size());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] += more[i];
    }
    if (!entry.index.empty()) {
      std::vector<double> chosen;
      for (const std::size_t i : entry.index) {
        if (i >= values.size()) wrong_length(entry.quantity, i + 1, values.size());
        chosen.push_back(values[i]);
      }
      values = std::move(chosen);
    }
    if (!entry.statistic.empty()) values = {statistic_of(entry.statistic, values)};
    if (!entry.exact.empty() && entry.exact.size() != values.size())
      wrong_length(entry.quantity, entry.exact.size(), values.size());
    all.push_back(std::move(values));
  }
  return all;
}

CostStudy load_cost_study(const fs::path& file, SweepExtent extent, const References& references) {
  const Document document = Document::from_json(file.string(), read_json(file));
  document.validate("cost");
  const JsonView root(document);
  CostStudy study;
  study.id = root.text("id");
  study.family = root.text("family");
  study.title = root.text("title");
  study.description = root.get<std::string>("description", "");
  for (const auto& [name, curve] : root["curves"].entries()) {
    std::vector<Setting> curve_settings = read_curve(root, name, curve, extent, references);
    std::ranges::move(curve_settings, std::back_inserter(study.settings));
  }
  study.baseline = find_baseline_setting(root["baseline"], study.settings);
  read_reference_solution(root, study, references);
  study.outputs = read_outputs(root);
  validate_quantity_counts(root, study);
  study.norm = root.get("norm", study.norm);
  study.time_limit_s = root.get("time_limit_s", study.time_limit_s);
  return study;
}

CostStudy cost_study_without_settings(const Case& given, const std::string& variant) {
  CostStudy study;
  study.id = given.id() + (variant == kBaseVariant ? "" : "-" + variant);
  study.family = given.document.value().value("family", given.id());
  study.title = given.title();
  if (variant != kBaseVariant) study.title += ": " + given.variant_title(variant);
  return study;
}

bool is_cost_study(const fs::path& file) {
  const Json json = read_json(file);
  return json.is_object() && json.contains("curves");
}

std::vector<fs::path> cost_study_files() {
  std::vector<fs::path> files;
  const fs::path folder = data_root() / "cases" / "cost";
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace trammel::harness
