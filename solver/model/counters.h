#pragma once

#include <Eigen/SparseCore>
#include <cstdint>

#include "solver/model/effects.h"

namespace trammel::solver {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// What was evaluated; the same on every machine, and zero for what a scene does not call for.
struct Counters {
  std::int64_t element_evaluations = 0;  ///< element matrices
  std::int64_t factorizations = 0;
  std::int64_t solves = 0;  ///< right-hand sides, refinement included
  std::int64_t steps = 0;   ///< of time or load, rejected ones included
  EffectCounts effects{};   ///< by effect

  void count(Effect effect, std::int64_t evaluations) {
    effects[static_cast<std::size_t>(effect)] += evaluations;
  }
  [[nodiscard]] std::int64_t evaluations(Effect effect) const {
    return effects[static_cast<std::size_t>(effect)];
  }
  Counters& operator+=(const Counters& other);
};

}  // namespace trammel::solver
