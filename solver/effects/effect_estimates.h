#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/model/effects.h"
#include "solver/model/outcome.h"

/// What a scene would lose without an effect, to first order, from one solution of it: an effect
/// that is small enters the solution as a small load, so that one factorization answers for all.
namespace trammel::solver {

/// Of one effect.
struct EffectEstimate {
  Effect effect{};
  /// The dimensionless number that tells why, as `number_of` in words; the largest over the poses.
  double number = 0;
  /// Without the effect less with it, of every displacement, rotation, force and moment over the
  /// largest of its kind, or of every frequency over itself. A sum over effects is their joint
  /// change.
  Eigen::VectorXd change;
  [[nodiscard]] double size() const { return change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0; }
  /// Appends the changes of another pose or speed.
  void append(const Eigen::VectorXd& more) {
    change.conservativeResize(change.size() + more.size());
    change.tail(more.size()) = more;
  }
};

struct EffectEstimates {
  Outcome outcome;  ///< without a linear solution there are no estimates
  std::vector<EffectEstimate> effects;
  Counters counters;
};

/// None yet of each applicable effect.
[[nodiscard]] inline std::vector<EffectEstimate> no_estimates(Effects applicable) {
  std::vector<EffectEstimate> estimates;
  for (const Effect effect : applicable.list()) estimates.push_back({effect, 0, {}});
  return estimates;
}

}  // namespace trammel::solver
