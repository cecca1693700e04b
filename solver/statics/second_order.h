#pragma once

#include <Eigen/Core>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/model/counters.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// Second-order theory: (K + K_G) q = f, K_G from the forces that hold q itself.
struct SecondOrderState {
  Outcome outcome;  ///< singular: a motion buckles on the way; not_converged: no equilibrium beyond
                    ///< the share of the loads that the reason names
  Eigen::VectorXd q;  ///< free coordinates [m, rad]
  Prestress forces;   ///< of q
  double error = 1;  ///< estimate of max |du| / max |u| as in linear_solution.h, with what rounding
                     ///< of the state's forces and the last iteration leave
};

/// Follows the equilibria from the unloaded state: where K + K_G of the latest forces, solved again
/// and again, does not settle under the whole load, the load is put on in steps. The state found is
/// stable: K + K_G has no negative pivot (Sylvester) in any step.
/// @param linear  solution of K q = f
[[nodiscard]] SecondOrderState solve_second_order(const System& system,
                                                  const Eigen::VectorXd& linear,
                                                  Counters& counters);

}  // namespace trammel::solver
