#pragma once

#include <Eigen/Core>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Options of a buckling analysis.
struct BucklingOptions {
  Index count = 3;
  EigenMethod method = EigenMethod::automatic;
};

/// Result of linear buckling, K x = -factor K_G x. All loads of the model grow together. K_G
/// follows from the forces of first-order statics. Only positive factors are computed, which keep
/// the sense of the loads.
struct BucklingSolution {
  Outcome outcome;              ///< singular: the model is a mechanism without any load
  Eigen::VectorXd load_factor;  ///< ascending [-]; empty if there is none up to `checked_factor`
  /// Load factor up to which the inertia of K + factor K_G was counted [-]. It is 0 if the loads
  /// change no stiffness.
  double checked_factor = 0;
  /// Estimated relative round-off error of each factor [-], as in ModalSolution.
  Eigen::VectorXd roundoff;
  Eigen::MatrixXd shape;  ///< free coordinate x factor, x^T |K_G| x = 1; see node_motion
  Evidence evidence;
  Counters counters;
};

/// Computes the lowest positive buckling factors. Failures are reported in `outcome`.
[[nodiscard]] BucklingSolution solve_buckling(const System& system,
                                              const BucklingOptions& options = {});

}  // namespace trammel::solver
