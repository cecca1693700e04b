#include "solver/model/counters.h"

namespace trammel {

Counters& Counters::operator+=(const Counters& more) {
  element_evaluations += more.element_evaluations;
  factorizations += more.factorizations;
  solves += more.solves;
  steps += more.steps;
  for (std::size_t i = 0; i < effect_count; ++i) effects[i] += more.effects[i];
  return *this;
}

}  // namespace trammel
