#pragma once

#include <Eigen/Core>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// Displacements of a static state.
struct StaticState {
  Outcome outcome;    ///< singular with the free motion in words; not converged below one digit
  Eigen::VectorXd q;  ///< free coordinates [m, rad]
  Prestress forces;   ///< second-order theory: of q
  double error = 1;   ///< bound of max |du| / max |u|, rotations times the size of the model
};

/// K q = f, refined with residuals from the elements. If K has lost too many digits to be factored,
/// q is solved for from the deformations of the elements and their forces (augmented_system.h).
[[nodiscard]] StaticState solve_linear_statics(const System& system, Counters& counters);

/// Not converged where a relative error of the displacements leaves less than one digit.
[[nodiscard]] Outcome outcome_by_error(double error);

/// What rounding leaves uncertain of the largest force of an element on a node, of that force: a
/// stiff element's deformation is what remains of motions that cancel.
[[nodiscard]] double force_roundoff(const System& system, const Eigen::VectorXd& q);

}  // namespace trammel::solver
