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

/// Result of linear buckling, K x = -factor K_G x, with the stiffness matrix K and the geometric
/// stiffness matrix K_G. The factor multiplies all loads. K_G follows from the internal forces of
/// first-order statics. Only positive factors are computed, because negative factors reverse the
/// loads.
struct BucklingSolution {
  /// singular: the unloaded model is a mechanism, or statics does not determine internal forces.
  Outcome outcome;
  /// Buckling factors [-], ascending; empty if all positive factors exceed `checked_factor`.
  Eigen::VectorXd load_factor;
  /// Largest load factor [-] that was checked. The negative pivots of K + factor K_G show if the
  /// model buckles below this factor. The value is 0 if the loads cause no geometric stiffness.
  double checked_factor = 0;
  /// Estimated relative round-off error of each buckling factor [-], as defined in `ModalSolution`.
  Eigen::VectorXd roundoff;
  Eigen::MatrixXd shape;  ///< buckling shapes x, free coordinate x factor, x^T |K_G| x = 1
  Evidence evidence;
  Counters counters;
};

/// Computes the lowest positive buckling factors. Failures are reported in
/// BucklingSolution::outcome.
[[nodiscard]] BucklingSolution solve_buckling(const System& system,
                                              const BucklingOptions& options = {});

}  // namespace trammel::solver
