#pragma once

#include <Eigen/Core>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct BucklingOptions {
  Index count = 3;
  EigenMethod method = EigenMethod::automatic;
};

/// Linear buckling K x = -factor K_G x under all loads of the model growing together, K_G from the
/// forces of first-order statics. Positive factors only: loads in their given sense.
struct BucklingSolution {
  Outcome outcome;              ///< singular: the model is a mechanism before any load
  Eigen::VectorXd load_factor;  ///< ascending [-]; empty if there is none up to checked_factor
  /// Load factor up to which the inertia of K + factor K_G was counted [-]; 0 if the loads change
  /// no stiffness.
  double checked_factor = 0;
  /// Estimate of each factor's relative round-off error [-], as in ModalSolution.
  Eigen::VectorXd roundoff;
  Eigen::MatrixXd shape;  ///< free coordinate x factor, x^T |K_G| x = 1; see node_motion
  Evidence evidence;
  Counters counters;
};

[[nodiscard]] BucklingSolution solve_buckling(const System& system,
                                              const BucklingOptions& options = {});

}  // namespace trammel::solver
