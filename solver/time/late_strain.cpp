#include "solver/time/late_strain.h"

#include <algorithm>

namespace trammel::solver {

using Eigen::VectorXd;

RegularizedMass::RegularizedMass(const System& system) : system_(system) {
  constexpr double kShare = 1e-6;
  double fastest = 0;
  for (Index i = 0; i < system.M.rows(); ++i) {
    const double mass = system.M.coeff(i, i);
    if (mass > 0) fastest = std::max(fastest, system.K.coeff(i, i) / mass);
  }
  SparseMatrix sum = system.M;
  if (fastest > 0) sum += kShare / fastest * system.K;
  regular_.compute(sum);
}

VectorXd RegularizedMass::solve(const VectorXd& f) const {
  VectorXd a = regular_.solve(f);
  for (int pass = 0; pass < 2; ++pass) a += regular_.solve(f - system_.M * a);
  return a;
}

LateStrain::LateStrain(const System& system)
    : system_(system), mass_(system), weight_(system.T.transpose() * system.weight) {}

void LateStrain::put(const VectorXd& q, const Eigen::Vector2d& factors,
                     ElasticState& elastic) const {
  const VectorXd loads = factors[0] * (system_.f - weight_) + factors[1] * weight_;
  elastic.acceleration = system_.T * mass_.solve(loads - system_.K * q);
  elastic.load_factor = factors[0];
  elastic.weight_factor = factors[1];
}

}  // namespace trammel::solver
