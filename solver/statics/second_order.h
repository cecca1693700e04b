#pragma once

#include <Eigen/Core>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/model/counters.h"
#include "solver/statics/linear_solution.h"

namespace trammel::solver {

/// Forces of a state under loads.
/// @param u, load  of the unconstrained coordinates
/// @param before  if given, the constraint forces include the second-order terms of these
[[nodiscard]] Prestress forces_of(const System& system, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& load, const BodyForces& body,
                                  const Prestress* before = nullptr);

/// Second-order theory: (K + K_G) q = f, K_G from the forces that hold q itself. Singular if a
/// motion buckles on the way; not converged if there is no equilibrium beyond the share of the
/// loads that the reason names. The error includes rounding of the state's forces and the last
/// iteration.
///
/// Follows the equilibria from the unloaded state: where K + K_G of the latest forces, solved again
/// and again, does not settle under the whole load, the load is put on in steps. The state found is
/// stable: K + K_G has no negative pivot (Sylvester) in any step.
/// @param linear  solution of K q = f
[[nodiscard]] StaticState solve_second_order(const System& system, const Eigen::VectorXd& linear,
                                             Counters& counters);

}  // namespace trammel::solver
