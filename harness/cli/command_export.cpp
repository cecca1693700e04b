#include "harness/cli/command_export.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/export/matrix_files.h"
#include "harness/input/catalogue.h"
#include "harness/run/run.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

/// Those that the case asks for; all where it asks for none.
Json quantities_json(const Case& given, const Quantities& quantities) {
  std::set<std::string> asked;
  if (const auto exported = JsonView(given.document).find("export")) {
    for (const auto& [number, place] : (*exported)["quantities"].entries())
      asked.insert(place.text("name"));
  }
  Json found = Json::object();
  for (const auto& [name, quantity] : quantities) {
    if (!asked.empty() && asked.count(name) == 0) continue;
    const bool has_gap =
        !std::ranges::all_of(quantity.values, [](double value) { return std::isfinite(value); });
    if (!has_gap) found[name] = {{"unit", unit_of(name)}, {"values", quantity.values}};
  }
  return found;
}

}  // namespace

int export_command(const std::string& name, const ExportCommand& command) {
  ExportChoice choice = command.choice;
  if (command.level >= 0) choice.level = static_cast<std::size_t>(command.level);
  const Case given = load_named_case(name);
  if (!command.matrices.empty()) {
    const Document document = chosen_document(given, choice);
    write_matrices(document, exported_scene(document), command.matrices);
    if (command.out.empty()) return 0;
  }
  const std::string text = pretty(export_case(given, choice));
  if (command.out.empty()) {
    std::cout << text;
  } else {
    write_file(command.out, text);
  }
  return 0;
}

int solve_command(const std::string& case_file, const std::string& result_file) {
  const Case given = load_case(case_file);
  RunOptions options;
  options.variant = kBaseVariant;
  options.memory_bytes = memory_limit_bytes();
  const std::vector<Run> runs = run_cases({given}, References(), options);
  require_complete(runs);
  const Run& run = runs.front();
  require_no_error(run);
  if (run.is_solved()) {
    for (const std::string& warning : run.warnings)
      std::cerr << "trammel: " << given.id() << ": warning: " << warning << '\n';
  }
  write_file(result_file, pretty({{"status", to_string(run.status)},
                                  {"reason", run.reason},
                                  {"quantities", quantities_json(given, run.quantities)},
                                  {"solver", {{"name", "trammel"}, {"version", TRAMMEL_VERSION}}},
                                  {"cost", {{"seconds", run.cost.wall_s}}}}));
  return 0;
}

}  // namespace trammel::harness
