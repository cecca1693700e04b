#include "solver/model/effects.h"

#include <algorithm>

namespace trammel::solver {

namespace {

constexpr std::array<std::string_view, kEffectCount> kNames = {"axial-flexibility",
                                                               "shear",
                                                               "rotary-inertia",
                                                               "platform-flexibility",
                                                               "joint-compliance",
                                                               "link-mass",
                                                               "gravity",
                                                               "inertia",
                                                               "damping",
                                                               "gyroscopic",
                                                               "geometric-stiffening",
                                                               "large-displacement"};

}  // namespace

std::vector<Effect> Effects::list() const {
  std::vector<Effect> effects;
  for (std::size_t i = 0; i < kEffectCount; ++i) {
    const auto effect = static_cast<Effect>(i);
    if (has(effect)) effects.push_back(effect);
  }
  return effects;
}

std::string_view name_of(Effect effect) {
  return kNames[static_cast<std::size_t>(effect)];
}

std::optional<Effect> find_effect(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<Effect>(found - kNames.begin());
}

Counters& Counters::operator+=(const Counters& other) {
  element_evaluations += other.element_evaluations;
  factorizations += other.factorizations;
  solves += other.solves;
  steps += other.steps;
  for (std::size_t i = 0; i < kEffectCount; ++i) effects[i] += other.effects[i];
  return *this;
}

}  // namespace trammel::solver
