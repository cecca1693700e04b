#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/predicate.hpp>
#include <iostream>

#include "harness/analysis/analysis.h"
#include "harness/analysis/registry.h"
#include "harness/analysis/size_estimate.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/cli/commands.h"
#include "harness/input/catalogue.h"
#include "harness/input/check.h"
#include "harness/input/json_view.h"
#include "harness/input/reference_library.h"
#include "harness/printing/printing.h"
#include "harness/readers/discretization.h"
#include "harness/results/quantity_definitions.h"
#include "harness/run/run.h"
#include "harness/scene/case_model.h"
#include "harness/scene/rethrow_as_input.h"
#include "harness/studies/validation_uncertainty.h"

namespace trammel::harness {
namespace {

std::string describe_model(const Document& document) {
  const char* without_model = find_analysis(analysis_kind(document)).without_model;
  if (!document.value().contains("model") && *without_model != 0) return without_model;
  const CaseModel case_model = read_case_model(document);
  const solver::Model model = build_without_joint_elements(case_model, 0);
  std::string text = "planar model";
  if (case_model.manipulator) {
    const bool rigid = case_model.manipulator->platform.kind == solver::PlatformDesign::Kind::rigid;
    const solver::Pose& pose = case_model.motion.front().pose;
    text = fmt::format("3-RRR manipulator with {}, ",
                       rigid ? "a rigid platform" : "a platform of triangles");
    text += case_model.path
                ? "along " + count_of(case_model.motion.size(), "pose")
                : fmt::format("at x = {} m, y = {} m, phi = {} rad", pose.x, pose.y, pose.phi);
  }
  solver::Index elements = 0;
  for (const solver::Member& member : model.members) elements += member.elements;
  text += "; " + count_of(model.nodes.size(), "node") + ", " +
          count_of(model.members.size(), "member") + " in " +
          count_of(static_cast<std::size_t>(elements), "element");
  const std::pair<std::size_t, const char*> parts[] = {
      {model.triangles.size(), "triangle"},
      {model.masses.size(), "point mass"},
      {model.springs.size(), "spring"},
      {case_model.joint_elements.line_springs.size(), "line spring"},
      {case_model.joint_elements.sliders.size(), "slider"},
      {model.loads.size(), "load"},
      {model.edge_loads.size(), "edge load"}};
  for (const auto& [count, noun] : parts)
    if (count > 0) text += ", " + count_of(count, noun);
  return text;
}

std::string describe_allowed_ranges(const Check& check) {
  if (check.windows.empty()) return "reported, not judged";
  if (check.symmetric) return fmt::format("within {}", check.windows[0].high);
  std::vector<std::string> each;
  for (const Window& window : check.windows)
    each.push_back("[" + shortest_decimal(window.low) + ", " + shortest_decimal(window.high) + "]");
  return "in " + join(each, "and");
}

std::string describe_check(const Check& check) {
  std::string text = check.statistic.empty() ? "" : check.statistic + " of ";
  text += check.quantity;
  if (!check.index.empty()) text += fmt::format("[{}]", fmt::join(check.index, ", "));
  if (!check.reference.empty()) text += " against " + check.reference;
  if (!check.against_quantity.empty()) text += " against " + check.against_quantity;
  if (!check.against_variant.empty()) text += " of variant " + check.against_variant;
  if (check.order) return text + ", order of convergence along sweep " + check.order->sweep;
  text += check.windows.empty() ? ", " : std::string(", ") + to_string(check.measure) + " ";
  text += describe_allowed_ranges(check);
  return check.expectation == Expectation::known_discrepancy
             ? text + " (recorded range of a known discrepancy)"
             : text;
}

void print_reference(const CitedReference& cited) {
  const auto& [reference, source] = cited;
  std::cout << "  " << reference.id << "  (" << to_string(reference.kind) << ", "
            << count_of(reference.values.size(), "value") << " in " << reference.unit << ")\n"
            << wrapped(reference.title, "      ")
            << wrapped(source.text + ", " + reference.place +
                           (source.doi.empty() ? "" : ", doi:" + source.doi),
                       "      ")
            << wrapped(reference.derivation, "      ") << wrapped(reference.notes, "      ");
  for (const auto& [label, texts] :
       {std::pair("Erratum: ", reference.errata), {"Ambiguity: ", reference.ambiguities}})
    for (const std::string& text : texts) std::cout << wrapped(label + text, "      ");
}

void describe_effects(const Document& document) {
  if (!supports_effects(document)) return;
  print_effects(rethrow_as_input_error(
      document, [&] { return choose_effects(document, read_case_model(document)); }));
}

void describe_checks(const Document& document, const std::vector<Check>& checks,
                     const References& references) {
  if (checks.empty()) return;
  std::cout << "\nChecks\n";
  const JsonView places = JsonView(document)["checks"];
  for (const Check& check : checks) {
    std::cout << "  " << check.name << "  (" << to_string(check.role) << ")\n"
              << wrapped(describe_check(check), "      ") << wrapped(check.why, "      ");
    if (!check.reference.empty()) (void)references.get(places[check.name]["reference"]);
  }
}

void describe_sweeps(const Case& given) {
  const auto sweeps = JsonView(given.document).find("sweeps");
  if (!sweeps) return;
  std::cout << "\nSweeps\n";
  for (const auto& [sweep, place] : sweeps->entries()) {
    std::cout << "  " << sweep << "  " << place["values"].json().dump();
    if (place.has("theory_order"))
      std::cout << ", order " << shortest_decimal(place.number("theory_order")) << " by theory";
    std::cout << '\n';
  }
}

/// Returns a table with one row for each value of the references.
Rows rows_of_reference_values(const std::vector<CitedReference>& all) {
  Rows rows({"id", "title", "kind", "unit", "index", "value", "uncertainty", "printed", "source",
             "place", "notes"});
  for (const auto& [reference, source] : all)
    for (std::size_t i = 0; i < reference.values.size(); ++i)
      rows.add({reference.id, reference.title, to_string(reference.kind), reference.unit, i,
                reference.values[i], reference.uncertainty[i],
                reference.printed.empty() ? "" : reference.printed[i], source.text, reference.place,
                reference.notes});
  return rows;
}

Json references_json(const std::vector<CitedReference>& all) {
  Json json = Json::array();
  for (const auto& [reference, source] : all) {
    Json& row = json.emplace_back(Json{{"id", reference.id},
                                       {"title", reference.title},
                                       {"kind", to_string(reference.kind)},
                                       {"unit", reference.unit},
                                       {"values", reference.values},
                                       {"uncertainty", reference.uncertainty},
                                       {"source", source.text},
                                       {"place", reference.place}});
    const std::pair<const char*, Json> rare[] = {{"printed", reference.printed},
                                                 {"notes", reference.notes},
                                                 {"derivation", reference.derivation},
                                                 {"errata", reference.errata},
                                                 {"ambiguities", reference.ambiguities}};
    for (const auto& [key, value] : rare)
      if (value != "" && value != Json::array()) row[key] = value;
  }
  return json;
}

void print_reference_values(const CitedReference& cited) {
  const references::Reference& reference = cited.reference;
  print_reference(cited);
  Rows table({"index", {"value", ">value [" + reference.unit + "]"}, {"uncertainty", "", 2}});
  for (std::size_t i = 0; i < reference.values.size(); ++i)
    table.add(
        {i,
         reference.printed.empty() ? shortest_decimal(reference.values[i]) : reference.printed[i],
         reference.uncertainty[i]});
  table.print(std::cout, "  ");
}

Rows analysis_kind_rows() {
  Rows rows({"analysis", "quantity", "unit", "meaning"});
  for (const AnalysisKind& kind : analysis_kinds())
    for (const results::QuantityDefinition& definition : results::quantity_definitions())
      if (definition.belongs_to_analysis(kind.name))
        rows.add({kind.name, definition.name, unit_of(definition.name), definition.meaning});
  return rows;
}

/// Returns the meaning of a quantity of a case. In a study, the quantity may belong to the analysis
/// that the study repeats.
std::string meaning_of_quantity(const std::string& name, const Document& document) {
  const std::string analysis = analysis_kind(document);
  const auto* found = results::find_quantity_definition(name, analysis);
  if (found == nullptr)
    found = results::find_quantity_definition(name, inner_analysis_kind(document));
  if (found == nullptr && analysis == "study")
    found = results::find_quantity_definition("parameter", analysis);
  return found == nullptr ? "" : found->meaning;
}

Rows quantity_table(const std::string& word) {
  const auto [given, chosen] = load_case_variant(word);
  const std::string variant = chosen.empty() ? kBaseVariant : chosen;
  const Document document = patched(given, variant);
  Rows rows({"quantity", "entries", "unit", "meaning"});
  for (const auto& [name, quantity] : run_variant(given, variant).quantities)
    rows.add({name, quantity.values.size(), unit_of(name), meaning_of_quantity(name, document)});
  return rows;
}

}  // namespace

int list_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  Rows rows(
      {{"id", "case"}, {"title"}, {"family"}, {"labels"}, {"analysis"}, {"variants"}, {"file"}});
  std::vector<Case> cases = Catalogue().load(options.labels, options.any_labels);
  std::erase_if(cases, [&](const Case& given) {
    return !boost::icontains(given.id() + ": " + given.title(), options.word);
  });
  for (const Case& given : cases)
    rows.add({given.id(), given.title(), given.document.value().value("family", ""), given.labels(),
              analysis_kind(given.document), given.variants(), given.file.string()});
  if (options.json) {
    std::cout << format_json(rows.json());
  } else {
    Rows({{"id", "case"}, {"analysis"}, {"variants", "", 0}, {"labels"}, {"title"}}, rows.json())
        .print(std::cout);
    std::cout << count_of(cases.size(), "case") << '\n';
  }
  return 0;
}

int describe_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const auto [given, chosen] = load_case_variant(options.word);
  for (const std::string& each : given.variants()) (void)patched(given, each);
  const std::string variant = chosen.empty() ? kBaseVariant : chosen;
  const Document document = patched(given, variant);
  if (options.json) {
    Json json = (chosen.empty() ? given.document : document).value();
    json["file"] = given.file.string();
    std::cout << format_json(json);
    return 0;
  }
  require_sufficient_memory(document);
  std::cout << given.id() << (chosen.empty() ? "" : ":" + chosen) << ": " << given.title() << '\n'
            << wrapped(given.document.value().value("description", ""), "  ") << "\nModel     "
            << describe_model(document) << "\nAnalysis  " << analysis_kind(document) << " "
            << document.value().at("analysis").begin()->dump() << "\nFile      "
            << given.file.string() << '\n';
  if (given.variants().size() > 1) {
    std::cout << "\nVariants\n";
    Rows table({"name", "title"});
    for (const std::string& other : given.variants())
      if (other != kBaseVariant) table.add({other, given.variant_title(other)});
    table.print(std::cout, "  ");
  }
  const References references;
  describe_sweeps(given);
  describe_effects(document);
  if (document.value().contains("uncertainty")) {
    std::cout << "\nInput uncertainties\n";
    for (const results::UncertainInput& input : uncertain_inputs(document, references))
      std::cout << wrapped(fmt::format("{} +- {}: {}", input.name, *input.half_width, input.why),
                           "  ");
  }
  describe_checks(document, read_checks(document, variant, given.variants()), references);
  const auto used = references.requested_references();
  if (!used.empty()) std::cout << "\nReferences\n";
  for (const auto& item : used) print_reference(item.second);
  return 0;
}

int quantities_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const Rows rows = options.word.empty() ? analysis_kind_rows() : quantity_table(options.word);
  if (options.json) {
    std::cout << format_json(rows.json(), 1);
  } else {
    rows.print(std::cout);
  }
  return 0;
}

int references_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const References library;
  const std::map<std::string, std::string> places = library.catalogue();
  std::vector<std::string> known, names = options.words;
  for (const auto& item : places) known.push_back(item.first);
  for (const std::string& name : names.empty() ? known : names) {
    if (places.count(name) == 0)
      throw InputError(unknown_name_message("a stored reference", name, known));
    (void)library.add(places.at(name));
  }
  std::vector<CitedReference> all;
  for (const auto& [id, reference] : library.requested_references()) all.push_back(reference);
  if (options.csv) {
    std::cout << rows_of_reference_values(all).csv();
  } else if (options.json) {
    std::cout << format_json(references_json(all));
  } else if (!names.empty()) {
    std::ranges::for_each(all, print_reference_values);
  } else {
    Rows table({"reference", "kind", "values", "unit", "source", "title"});
    for (const auto& [reference, source] : all)
      table.add({reference.id, to_string(reference.kind), reference.values.size(), reference.unit,
                 reference.source, reference.title});
    table.print(std::cout);
    std::cout << count_of(all.size(), "reference") << '\n';
  }
  return 0;
}

}  // namespace trammel::harness
