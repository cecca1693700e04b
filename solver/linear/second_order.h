#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Displacements of a static state.
struct StaticState {
  Outcome outcome;    ///< singular with the free motion in words; not converged below one digit
  Eigen::VectorXd q;  ///< free coordinates [m, rad]
  Prestress forces;   ///< second-order theory: of q
  double error = 1;   ///< bound of max |du| / max |u|, rotations times the size of the model
};

/// K q = f, refined with residuals from the elements. If K has lost too many digits to be factored,
/// q is solved for from the deformations of the elements and their forces (forward_error.h).
[[nodiscard]] StaticState solve_linear_statics(const System& system, Counters& counters);

/// Not converged where a relative error of the displacements leaves less than one digit.
[[nodiscard]] Outcome outcome_by_error(double error);

/// What rounding leaves uncertain of the largest force of an element on a node, of that force: a
/// stiff element's deformation is what remains of motions that cancel.
[[nodiscard]] double force_roundoff(const System& system, const Eigen::VectorXd& q);

/// Forces of a state under loads.
/// @param u, load  of the unconstrained coordinates
/// @param before  if given, the constraint forces include the second-order terms of these
[[nodiscard]] Prestress forces_of(const System& system, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& load, const BodyForces& body,
                                  const Prestress* before = nullptr);

/// Equilibrium (K + A + K_G) q = f of a state whose own forces hold it, K_G from these forces and A
/// the softening of a rotating frame, if there is one. Without A the state has to be stable:
/// K + K_G has no negative pivot (Sylvester). Functions that fail set the outcome of the state.
class StiffenedEquilibrium {
 public:
  /// Forces in q, from q and the forces of the matrix that q was solved with.
  using Forces = std::function<Prestress(const Eigen::VectorXd&, const Prestress*)>;

  StiffenedEquilibrium(const System& system, Counters& counters,
                       const SparseMatrix* softening = nullptr);

  /// Solves with K_G of the state's forces, none if they are empty; returns false if it fails.
  bool solve(const Eigen::VectorXd& f, StaticState& state);
  /// Solves and updates the forces until they repeat, from a state nearby.
  void iterate(const Eigen::VectorXd& f, const Forces& forces, StaticState& state);

  /// StaticState::error of the state that was solved last.
  [[nodiscard]] double error(const StaticState& state) const;
  /// A + K_G of the last solution, and (K + A + K_G) q with K q from the elements' deformations.
  [[nodiscard]] const SparseMatrix& added() const { return added_; }
  [[nodiscard]] Eigen::VectorXd times(const Eigen::VectorXd& q) const;
  [[nodiscard]] bool is_stable() const { return factorization_.smallest_pivot() > 0; }

 private:
  /// max |u|, rotations times the size of the model.
  [[nodiscard]] double measure(const Eigen::VectorXd& q) const;
  /// What rounding of the state's forces does to the displacements.
  [[nodiscard]] double force_rounding(const StaticState& state) const;

  const System& system_;
  Counters& counters_;
  const SparseMatrix* softening_;
  SparseMatrix lengths_, added_;
  Operator elastic_;
  Factorization factorization_;
  double left_ = 0;  // of q, what the latest iteration leaves
};

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
