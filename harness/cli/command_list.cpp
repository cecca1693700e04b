#include "harness/cli/command_list.h"

#include <iostream>

#include "harness/analysis/analysis.h"
#include "harness/analysis/registry.h"
#include "harness/analysis/size_estimate.h"
#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/input/catalogue.h"
#include "harness/input/check.h"
#include "harness/input/json_view.h"
#include "harness/input/reference_library.h"
#include "harness/printing/print_effects.h"
#include "harness/results/quantity_definitions.h"
#include "harness/run/run.h"
#include "harness/scene/case_model.h"
#include "harness/scene/with_model_errors.h"
#include "harness/studies/validation_uncertainty.h"

namespace trammel::harness {
namespace {

std::string family_of(const Case& given) {
  return given.document.value().value("family", "");
}

std::string text_of(const Case& given, const char* key) {
  return given.document.value().value(key, "");
}

Json summary(const Case& given) {
  return {{"id", given.id()},
          {"title", given.title()},
          {"family", family_of(given)},
          {"labels", given.labels()},
          {"analysis", analysis_kind(given.document)},
          {"variants", given.variants()},
          {"file", given.file.string()}};
}

std::string count_of(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string describe_model(const Document& document) {
  const char* without_model = find_analysis(analysis_kind(document)).without_model;
  if (!document.value().contains("model") && *without_model != 0) return without_model;
  const CaseModel case_model = read_case_model(document);
  const solver::Model model = build_bare_model(case_model, 0);
  std::string text;
  if (case_model.manipulator) {
    const auto& platform = case_model.manipulator->platform;
    text = platform.kind == solver::PlatformDesign::Kind::rigid
               ? "3-RRR manipulator with a rigid platform"
               : "3-RRR manipulator with a platform of triangles";
    const solver::Pose& pose = case_model.motion.front().pose;
    text += case_model.path ? ", along " + count_of(case_model.motion.size(), "pose")
                            : ", at x = " + shortest(pose.x) + " m, y = " + shortest(pose.y) +
                                  " m, phi = " + shortest(pose.phi) + " rad";
  } else {
    text = "planar model";
  }
  solver::Index elements = 0;
  for (const solver::Member& member : model.members) elements += member.elements;
  text += "; " + count_of(model.nodes.size(), "node") + ", " +
          count_of(model.members.size(), "member") + " in " +
          count_of(static_cast<std::size_t>(elements), "element");
  if (!model.triangles.empty()) text += ", " + count_of(model.triangles.size(), "triangle");
  if (!model.masses.empty()) text += ", " + count_of(model.masses.size(), "point mass");
  if (!model.springs.empty()) text += ", " + count_of(model.springs.size(), "spring");
  const solver::large_motion::LargeMotionModel& more = case_model.joint_elements;
  if (!more.line_springs.empty()) text += ", " + count_of(more.line_springs.size(), "line spring");
  if (!more.sliders.empty()) text += ", " + count_of(more.sliders.size(), "slider");
  if (!model.loads.empty()) text += ", " + count_of(model.loads.size(), "load");
  if (!model.edge_loads.empty()) {
    text += ", " + count_of(model.edge_loads.size(), "loaded side") + " of triangles";
  }
  return text;
}

std::string describe_windows(const Check& check) {
  if (check.windows.empty()) return "reported, not judged";
  if (check.symmetric) return "within " + shortest(check.windows[0].high);
  std::vector<std::string> each;
  for (const Window& window : check.windows) {
    each.push_back("[" + shortest(window.low) + ", " + shortest(window.high) + "]");
  }
  return "in " + join(each, "and");
}

std::string describe_check(const Check& check) {
  std::string text = check.statistic.empty() ? "" : check.statistic + " of ";
  text += check.quantity;
  if (!check.index.empty()) {
    std::vector<std::string> each;
    for (const std::size_t i : check.index) each.push_back(std::to_string(i));
    text += "[" + join(each, "and") + "]";
  }
  if (!check.reference.empty()) text += " against " + check.reference;
  if (!check.against_quantity.empty()) text += " against " + check.against_quantity;
  if (!check.against_variant.empty()) text += " of variant " + check.against_variant;
  if (check.order && check.order->two_term_within) {
    return text + ", a law of two orders along sweep " + check.order->sweep + " within " +
           shortest(*check.order->two_term_within) + " of the errors";
  }
  if (check.order) {
    return text + ", order along sweep " + check.order->sweep + " within " +
           shortest(check.order->within) + " of theory";
  }
  text += check.windows.empty() ? ", " : std::string(", ") + to_string(check.measure) + " ";
  text += describe_windows(check);
  if (check.expectation == Expectation::known_discrepancy)
    text += " (does not agree; recorded range)";
  return text;
}

void describe_effects(const Case& given) {
  const Document base = patched(given, kBaseVariant);
  if (!knows_effects(base)) return;
  const EffectChoice choice =
      with_model_errors(base, [&] { return choose_effects(base, read_case_model(base)); });
  print_effects(choice, analysis_kind(base));
}

void describe_checks(const Case& given, const References& references) {
  const Document base = patched(given, kBaseVariant);
  const std::vector<Check> checks = read_checks(base, kBaseVariant, given.variants());
  if (checks.empty()) return;
  std::cout << "\nChecks\n";
  const JsonView places = JsonView(base)["checks"];
  for (const Check& check : checks) {
    std::cout << "  " << check.name << "  (" << to_string(check.role) << ")\n"
              << wrapped(describe_check(check), "      ") << wrapped(check.why, "      ");
    if (!check.reference.empty()) (void)references.get(places[check.name]["reference"]);
  }
}

void describe_inputs(const Case& given, const References& references) {
  const Document base = patched(given, kBaseVariant);
  if (!base.value().contains("uncertainty")) return;
  std::cout << "\nInput uncertainties\n";
  Table table({"input", ">half width", "", "why"});
  for (const results::UncertainInput& input : stated_inputs(base, references)) {
    table.add({input.name, rounded(*input.half_width),
               input.nominal ? "in the literal reading alone" : "", input.why});
  }
  table.print(std::cout, "  ");
}

void describe_references(const References& references) {
  const auto used = references.used();
  if (used.empty()) return;
  std::cout << "\nReferences\n";
  for (const auto& [id, cited] : used) {
    const references::Reference& reference = cited.reference;
    std::cout << "  " << id << "  (" << to_string(reference.kind) << ", "
              << count_of(reference.values.size(), "value") << " in " << reference.unit << ")\n"
              << wrapped(reference.title, "      ")
              << wrapped(cited.source.text + ", " + reference.place +
                             (cited.source.doi.empty() ? "" : ", doi:" + cited.source.doi),
                         "      ");
    for (const std::string& erratum : reference.errata) {
      std::cout << wrapped("Erratum: " + erratum, "      ");
    }
  }
}

void print_analyses() {
  for (const AnalysisKind& kind : analysis_kinds()) {
    std::cout << kind.name << '\n';
    Table table({"quantity", "unit", "meaning"});
    for (const results::QuantityDefinition& one : results::quantity_definitions())
      if (one.is_of(kind.name)) table.add({one.name, unit_of(one.name), one.meaning});
    table.print(std::cout, "  ");
  }
  std::cout << "A colon is followed by what the quantity is of: a node, a member and its end, ...\n"
               "Times and poses stand beside quantities along a trajectory; a study gives the\n"
               "quantities of its analysis. './trammel quantities CASE' names those of a case.\n";
}

Json analyses_json() {
  Json json = Json::array();
  for (const AnalysisKind& kind : analysis_kinds())
    for (const results::QuantityDefinition& one : results::quantity_definitions())
      if (one.is_of(kind.name))
        json.push_back({{"analysis", kind.name},
                        {"quantity", one.name},
                        {"unit", unit_of(one.name)},
                        {"meaning", one.meaning}});
  return json;
}

/// Of a quantity of the case, which in a study may be one of the analysis that is studied.
std::string meaning_of(const std::string& name, const Document& document) {
  const std::string analysis = analysis_kind(document);
  const auto* found = results::find_quantity_definition(name, analysis);
  if (found == nullptr && analysis == "study") {
    const Json& studied = document.value().at("analysis").at("study").at("analysis");
    found = results::find_quantity_definition(name, studied.begin().key());
    if (found == nullptr) found = results::find_quantity_definition("parameter", analysis);
  }
  return found == nullptr ? "" : found->meaning;
}

}  // namespace

int list_cases(const std::vector<std::string>& labels, bool json) {
  const std::vector<Case> cases = Catalogue().load(labels);
  if (json) {
    Json all = Json::array();
    for (const Case& test_case : cases) all.push_back(summary(test_case));
    std::cout << pretty(all);
    return 0;
  }
  Table table({"case", "analysis", ">variants", "labels", "title"});
  for (const Case& test_case : cases) {
    std::string labels_text;
    for (const std::string& label : test_case.labels()) {
      labels_text += (labels_text.empty() ? "" : ",") + label;
    }
    table.add({test_case.id(), analysis_kind(test_case.document),
               std::to_string(test_case.variants().size()), labels_text, test_case.title()});
  }
  table.print(std::cout);
  std::cout << count_of(cases.size(), "case") << '\n';
  return 0;
}

int describe_case(const std::string& name, bool json) {
  const Case given = load_named_case(name);
  if (json) {
    Json document = given.document.value();
    document["file"] = given.file.string();
    std::cout << pretty(document);
    return 0;
  }
  require_fits(patched(given, kBaseVariant));
  const References references;
  std::cout << given.id() << ": " << given.title() << '\n';
  std::cout << wrapped(text_of(given, "description"), "  ");
  std::cout << "\nModel     " << describe_model(patched(given, kBaseVariant)) << '\n';
  std::cout << "Analysis  " << analysis_kind(given.document) << " "
            << given.document.value().at("analysis").begin()->dump() << '\n';
  std::cout << "File      " << given.file.string() << '\n';
  if (given.variants().size() > 1) {
    std::cout << "\nVariants\n";
    Table table({"name", "what it changes"});
    for (const std::string& variant : given.variants()) {
      if (variant != kBaseVariant) table.add({variant, given.variant_title(variant)});
    }
    table.print(std::cout, "  ");
  }
  if (const auto sweeps = JsonView(given.document).find("sweeps")) {
    std::cout << "\nSweeps\n";
    for (const auto& [sweep, place] : sweeps->entries()) {
      std::cout << "  " << sweep << "  " << place["values"].json().dump();
      if (place.has("theory_order")) {
        std::cout << ", order " << shortest(place.number("theory_order"));
        if (place.has("lower_order")) std::cout << " and " << shortest(place.number("lower_order"));
        std::cout << " by theory";
      }
      std::cout << '\n';
    }
  }
  describe_effects(given);
  describe_inputs(given, references);
  describe_checks(given, references);
  describe_references(references);
  return 0;
}

int quantities_command(const std::string& name, bool json) {
  if (name.empty()) {
    if (json) {
      std::cout << pretty(analyses_json(), 1);
    } else {
      print_analyses();
    }
    return 0;
  }
  const Case given = load_named_case(name);
  const Document document = patched(given, kBaseVariant);
  const Run result = solution_of(given, kBaseVariant);
  Table table({"quantity", ">entries", "unit", "meaning"});
  Json rows = Json::array();
  for (const auto& [quantity, found] : result.quantities) {
    const std::string unit = unit_of(quantity), meaning = meaning_of(quantity, document);
    table.add({quantity, std::to_string(found.values.size()), unit, meaning});
    rows.push_back({{"quantity", quantity},
                    {"entries", found.values.size()},
                    {"unit", unit},
                    {"meaning", meaning}});
  }
  if (json) {
    std::cout << pretty(rows, 1);
  } else {
    table.print(std::cout, "");
  }
  return 0;
}

}  // namespace trammel::harness
