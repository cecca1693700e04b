#include "harness/cli/print_effects.h"

#include <iostream>

#include "harness/base/table.h"
#include "harness/base/text.h"

namespace trammel {

std::string effect_names(Effects effects) {
  std::vector<std::string> names;
  for (const Effect effect : effects.list()) names.emplace_back(name_of(effect));
  return names.empty() ? "none" : join(names, "and");
}

namespace {

std::string names_where(const EffectChoice& choice, bool on, bool admitted) {
  std::vector<std::string> names;
  for (const EffectReason& one : choice.reasons) {
    if (one.on == on && (on || one.admitted == admitted)) names.emplace_back(name_of(one.effect));
  }
  return names.empty() ? "none" : join(names, "and");
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
  Table table({"effect", "", ">number", "which is", ">change without [%]"});
  for (const EffectReason& one : choice.reasons) {
    table.add({std::string(name_of(one.effect)),
               one.on         ? "on"
               : one.admitted ? "off"
                              : "-",
               one.number ? rounded(*one.number, 3) : "",
               one.number ? number_words(one.effect, analysis) : "",
               one.change ? rounded(100 * *one.change, 3) : ""});
  }
  table.print(std::cout, "  ");
  for (const EffectReason& one : choice.reasons) {
    const std::string name(name_of(one.effect));
    std::cout << wrapped(name + ": " +
                             (one.on         ? "on, "
                              : one.admitted ? "off, "
                                             : "not there, ") +
                             one.why,
                         "      ");
  }
}

}  // namespace trammel
