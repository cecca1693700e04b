#pragma once

#include <vector>

#include "solver/model/counters.h"
#include "solver/model/effects.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// What a scene would lose without an effect, to first order.
struct EffectEstimate {
  Effect effect{};
  double number = 0;  ///< without dimension: why it is so
  double change = 0;  ///< of the results, relative
};

struct EffectEstimates {
  Outcome outcome;  ///< without a linear solution there are no estimates
  std::vector<EffectEstimate> effects;
  /// At most what large displacement changes of the motion without vibration; relative.
  double large_displacement_bound = 0;
  /// What that means for the motion: the factor of such a change, and what is beside it.
  double large_displacement_growth = 1, large_displacement_beside = 0;
  std::vector<double> extreme_times;  ///< of the response [s]
  Counters counters;
};

}  // namespace trammel::solver
