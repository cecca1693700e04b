#include "harness/print_effects.h"

#include <iostream>

#include "harness/table.h"
#include "harness/words.h"

namespace trammel {

std::string effect_names(Effects effects) {
  std::vector<std::string> names;
  for (const Effect effect : effects.list()) names.emplace_back(name_of(effect));
  return names.empty() ? "none" : join(names, "and");
}

void print_effects(const EffectChoice& choice, const std::string& analysis) {
  std::cout << "\nEffects";
  if (choice.tolerance)
    std::cout << ", those that a tolerance of " << *choice.tolerance << " calls for";
  std::cout << '\n';
  Table table({"effect", "", ">number", "of", ">change without [%]"});
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
