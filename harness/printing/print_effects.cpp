#include "harness/printing/print_effects.h"

#include <iostream>

#include "harness/base/rows.h"
#include "harness/base/text.h"

namespace trammel::harness {

std::string effect_names(const std::vector<solver::Effect>& effects) {
  std::vector<std::string> names;
  for (const solver::Effect effect : effects) names.emplace_back(solver::name_of(effect));
  return names.empty() ? "none" : join(names, "and");
}

namespace {

std::string names_where(const EffectChoice& choice, bool active, bool applicable) {
  std::vector<solver::Effect> effects;
  for (const EffectReason& reason : choice.reasons)
    if (reason.active == active && (active || reason.applicable == applicable))
      effects.push_back(reason.effect);
  return effect_names(effects);
}

/// What the case's parts or its own list say, in three lines.
void print_stated(const EffectChoice& choice) {
  std::cout << "\nEffects\n"
            << wrapped("on: " + names_where(choice, true, true), "  ")
            << wrapped("left out: " + names_where(choice, false, true), "  ")
            << wrapped("not in the model: " + names_where(choice, false, false), "  ");
}

}  // namespace

void print_effects(const EffectChoice& choice, const std::string& analysis) {
  if (!choice.tolerance) return print_stated(choice);
  std::cout << "\nEffects, those that a tolerance of " << *choice.tolerance << " calls for\n";
  Rows table({"effect", "", ">number", "which is", ">change without [%]"});
  for (const EffectReason& reason : choice.reasons) {
    table.add({std::string(solver::name_of(reason.effect)),
               reason.active       ? "on"
               : reason.applicable ? "off"
                                   : "-",
               reason.number ? rounded(*reason.number, 3) : "",
               reason.number ? describe_effect_number(reason.effect, analysis) : "",
               reason.change ? rounded(100 * *reason.change, 3) : ""});
  }
  table.print(std::cout, "  ");
  for (const EffectReason& reason : choice.reasons) {
    const std::string name(solver::name_of(reason.effect));
    std::cout << wrapped(name + ": " +
                             (reason.active       ? "on, "
                              : reason.applicable ? "off, "
                                                  : "not there, ") +
                             reason.why,
                         "      ");
  }
}

}  // namespace trammel::harness
