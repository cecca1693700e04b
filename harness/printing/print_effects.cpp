#include <iostream>

#include "harness/base/rows.h"
#include "harness/base/text.h"
#include "harness/printing/printing.h"

namespace trammel::harness {

std::string effect_names(solver::Effects effects) {
  std::vector<std::string> names;
  for (const solver::Effect effect : effects.list()) names.emplace_back(solver::name_of(effect));
  return names.empty() ? "none" : join(names, "and");
}

void print_effects(const EffectChoice& choice) {
  solver::Effects applicable;
  for (std::size_t i = 0; i < choice.rows.size(); ++i)
    if (choice.rows[i].applicable) applicable = applicable.with(static_cast<solver::Effect>(i));
  if (!choice.automatic) {
    std::cout << "\nEffects\n"
              << wrapped("on: " + effect_names(choice.chosen), "  ")
              << wrapped("omitted: " + effect_names(applicable.without(choice.chosen)), "  ")
              << wrapped("not in the model: " +
                             effect_names(solver::Effects::all().without(applicable)),
                         "  ");
    return;
  }
  std::cout << "\nEffects required for a tolerance of " << percent(*choice.tolerance) << '\n';
  Rows table({"effect",
              {"state", ""},
              {"number", "", 3},
              {"definition"},
              {"own", "own [%]", 3, 100},
              {"cumulative", "cumulative [%]", 3, 100}});
  for (const results::EffectRow& row : choice.rows)
    table.add({row.name,
               row.active       ? "on"
               : row.applicable ? "off"
                                : "-",
               number_or_null(row.dimensionless_number), row.number_definition,
               number_or_null(row.own_change), number_or_null(row.cumulative_change)});
  table.print(std::cout, "  ");
  std::cout << "  own: change of the results without this effect; cumulative: without this effect "
               "and those removed before it\n";
  for (const results::EffectRow& row : choice.rows)
    std::cout << wrapped(row.name + ": " + row.why, "      ");
  std::cout << "  total: at most " << percent(choice.automatic->change)
            << ", the sum of measured changes and bounds\n";
}

}  // namespace trammel::harness
