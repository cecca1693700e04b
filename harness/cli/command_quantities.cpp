#include "harness/cli/command_quantities.h"

#include <iostream>

#include "harness/analysis/registry.h"
#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/input/catalogue.h"
#include "harness/results/quantity_definitions.h"
#include "harness/run/run.h"

namespace trammel::harness {
namespace {

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
  const AnalysisResult result = solution_of(given, kBaseVariant);
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
