#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// K q = f, refined with residuals from the elements. Where K has lost too many digits to be
/// factored, from the deformations of the elements and their forces (augmented_system.h).
struct LinearSolution {
  Outcome outcome;  ///< singular with the free motion in words; not converged below one digit
  Eigen::VectorXd q;
  double error = 1;  ///< bound of max |du| / max |u|, rotations times the size of the model
};

[[nodiscard]] LinearSolution solve_linear_statics(const System& system, Counters& counters);

/// Not converged where a relative error of the displacements leaves less than one digit.
[[nodiscard]] Outcome outcome_by_error(double error);

/// What rounding leaves uncertain of the largest force of an element on a node, of that force: a
/// stiff element's deformation is what remains of motions that cancel.
[[nodiscard]] double force_roundoff(const System& system, const Eigen::VectorXd& q);

}  // namespace trammel::solver
