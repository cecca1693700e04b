#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"
#include "solver/linalg/factorization.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {

/// M a = f on the free coordinates where M may be singular: a small share of K is added, and what
/// it moves masses by is taken back. What has no mass then strains least.
class RegularizedMass {
 public:
  /// @pre `system` outlives this
  explicit RegularizedMass(const System& system);
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& f) const;

 private:
  const System& system_;
  Factorization regular_;
};

/// What balances the strains of a motion that is damped in proportion to stiffness. K (q + t q')
/// makes them follow loads and inertia late: x + t x' = all of these, and K q = x of the loads -
/// M x of the accelerations.
class LateStrain {
 public:
  /// @pre `system` outlives this
  explicit LateStrain(const System& system);
  /// Puts loads and accelerations into `elastic` that balance K q.
  /// @param factors  of loads and of weight, each followed late (followed_factors)
  void put(const Eigen::VectorXd& q, const Eigen::Vector2d& factors, ElasticState& elastic) const;

 private:
  const System& system_;
  RegularizedMass mass_;
  Eigen::VectorXd weight_;  // on the free coordinates
};

}  // namespace trammel::solver
