#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>

#include "harness/base/json_file.h"
#include "harness/cli/commands.h"
#include "harness/export/exported_case.h"
#include "harness/input/catalogue.h"
#include "harness/run/run.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

/// Returns the quantities that the case requests; all quantities if the case requests none.
Json requested_quantities_json(const Case& given, const Quantities& quantities) {
  std::set<std::string> asked;
  if (const auto exported = JsonView(given.document).find("export"))
    for (const auto& [number, place] : (*exported)["quantities"].entries())
      asked.insert(place.text("name"));
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

int export_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  ExportChoice choice;
  const auto [given, variant] = load_case_variant(options.word, options.variant);
  if (!variant.empty()) choice.variant = variant;
  if (!options.sweeps.empty()) choice.sweep = options.sweeps.front();
  if (options.level >= 0) choice.level = static_cast<std::size_t>(options.level);
  if (!options.matrices.empty()) {
    const Document document = case_with_chosen_patches(given, choice);
    write_system_matrices(document, exported_scene(document), options.matrices);
    if (options.out.empty()) return 0;
  }
  const std::string text = format_json(export_case(given, choice));
  if (options.out.empty()) {
    std::cout << text;
  } else {
    write_file(options.out, text);
  }
  return 0;
}

int solve_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const auto [given, variant] = load_case_variant(options.word);
  RunOptions run_options;
  run_options.variant = variant.empty() ? kBaseVariant : variant;
  run_options.memory_bytes = options.memory_bytes;
  const std::vector<Run> runs = run_cases({given}, References(), run_options);
  require_uninterrupted(runs);
  const Run& run = runs.front();
  require_no_error(run);
  if (run.is_solved())
    for (const std::string& warning : run.warnings)
      std::cerr << "trammel: " << given.id() << ": warning: " << warning << '\n';
  write_file(options.out,
             format_json({{"status", to_string(run.status)},
                          {"reason", run.reason},
                          {"quantities", requested_quantities_json(given, run.quantities)},
                          {"solver", {{"name", "trammel"}, {"version", TRAMMEL_VERSION}}},
                          {"cost", {{"seconds", run.cost.wall_s}}}}));
  return 0;
}

}  // namespace trammel::harness
