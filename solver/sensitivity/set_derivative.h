#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"
#include "solver/sensitivity/seeded_design.h"

namespace trammel::solver {

/// U^T (dK/dp - w^2 dM/dp) U on the unconstrained coordinates, for a set of modes U of one w.
class SetDerivative {
 public:
  SetDerivative(const System& system, const Eigen::MatrixXd& U, double omega_squared);

  /// @returns mode x mode, symmetric; not finite where a limb is straight or folded
  [[nodiscard]] Eigen::MatrixXd of(const SeededDesign& design) const;

 private:
  void add_element(const FrameElement& e, const SeededLink& link, Eigen::MatrixXd& sum) const;
  void add_constraints(const SeededDesign& design, Eigen::MatrixXd& sum) const;
  void add_platform(const SeededDesign& design, Eigen::MatrixXd& sum) const;

  const System& system_;
  const Eigen::MatrixXd& U_;
  double omega_squared_;
  bool inextensible_ = false;
  Eigen::MatrixXd multipliers_;  // constraint row x mode
};

}  // namespace trammel::solver
