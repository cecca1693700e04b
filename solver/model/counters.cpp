#include "solver/model/counters.h"

namespace trammel::solver {

Counters& Counters::operator+=(const Counters& other) {
  element_evaluations += other.element_evaluations;
  factorizations += other.factorizations;
  solves += other.solves;
  steps += other.steps;
  for (std::size_t i = 0; i < kEffectCount; ++i) effects[i] += other.effects[i];
  return *this;
}

}  // namespace trammel::solver
