#pragma once

#include <Eigen/Core>
#include <functional>

#include "solver/linalg/factorization.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Equilibrium state of statics: displacements, internal forces and error bound.
struct StaticState {
  /// singular: the reason describes the zero-energy mode. not_converged: the displacements have
  /// less than one correct digit.
  Outcome outcome;
  Eigen::VectorXd q;  ///< free coordinates [m, rad]
  /// Internal forces of q; only computed in second-order theory.
  Prestress forces;
  /// Bound of max |du| / max |u|, with the error du. Rotations are multiplied by the model size.
  double error = 1;
};

/// Solves K q = f by iterative refinement with residuals that are computed from the elements. If K
/// is too ill-conditioned to be factored, the deformations and forces of the elements are solved
/// for simultaneously (forward_error.h).
[[nodiscard]] StaticState solve_linear_statics(const System& system, Counters& counters);

/// Returns `not_converged` if the relative error of the displacements exceeds 0.1, which means that
/// less than one digit is correct. Otherwise returns `solved`.
[[nodiscard]] Outcome outcome_by_displacement_error(double error);

/// Returns the round-off error of the forces of elements on nodes, relative to the largest force.
/// This error is large for stiff elements, because their deformations are small differences of
/// displacements.
[[nodiscard]] double relative_force_roundoff(const System& system, const Eigen::VectorXd& q);

/// Computes the internal forces of a state under loads.
/// @param system  assembled model.
/// @param u  displacements of the unconstrained coordinates [m, rad].
/// @param load  loads on the unconstrained coordinates [N, N m].
/// @param body  forces on members and point masses.
/// @param stiffening  internal forces that define a geometric stiffness matrix K_G, or null. If
///   given, the constraints also balance the forces K_G u.
[[nodiscard]] Prestress prestress_of(const System& system, const Eigen::VectorXd& u,
                                     const Eigen::VectorXd& load, const BodyForces& body,
                                     const Prestress* stiffening = nullptr);

/// Equilibrium (K + A + K_G) q = f with K_G from the internal forces of q. A is the softening
/// matrix of a rotating frame and may be absent. Without A, the state must be stable: K + K_G has
/// no negative pivot (Sylvester's law of inertia). Functions that fail set the outcome of the
/// state.
class StiffenedEquilibrium {
 public:
  /// Function that returns the internal forces of a state q. Its arguments are q and the internal
  /// forces that define the matrix K_G with which q was computed.
  using Forces = std::function<Prestress(const Eigen::VectorXd&, const Prestress*)>;

  StiffenedEquilibrium(const System& system, Counters& counters,
                       const SparseMatrix* softening = nullptr);

  /// Solves (K + A + K_G) q = f for q. K_G follows from the internal forces in `state`, or is
  /// omitted if `state` has no internal forces. Returns false if no solution is found.
  bool solve(const Eigen::VectorXd& f, StaticState& state);
  /// Solves (K + A + K_G) q = f repeatedly for q and updates K_G, until q and the internal forces
  /// converge. The iteration starts with `state`.
  void iterate(const Eigen::VectorXd& f, const Forces& forces, StaticState& state);

  /// Returns the bound of the relative error of the displacements (StaticState::error) for the last
  /// solution `state`.
  [[nodiscard]] double relative_displacement_error(const StaticState& state) const;
  /// Returns the sum of the softening matrix A and the geometric stiffness matrix K_G in the last
  /// equation that was solved.
  [[nodiscard]] const SparseMatrix& added_stiffness() const { return added_; }
  /// Returns the restoring forces (K + A + K_G) q of elastic stiffness, softening and geometric
  /// stiffness [N, N m]. K q is computed from the deformations of the elements.
  [[nodiscard]] Eigen::VectorXd restoring_forces(const Eigen::VectorXd& q) const;
  [[nodiscard]] bool is_stable() const { return factorization_.smallest_pivot() > 0; }

 private:
  /// Returns the largest magnitude of the displacements u = T q [m]; rotations are multiplied by
  /// the model size.
  [[nodiscard]] double largest_displacement(const Eigen::VectorXd& q) const;
  /// Returns the error of the displacements [m] caused by the round-off error of the internal
  /// forces.
  [[nodiscard]] double displacement_roundoff_of_forces(const StaticState& state) const;

  const System& system_;
  Counters& counters_;
  const SparseMatrix* softening_;
  SparseMatrix lengths_, added_;
  Operator elastic_;
  Factorization factorization_;
  // Estimated relative iteration error of q after the last iteration.
  double left_ = 0;
};

/// Solves (K + K_G) q = f by second-order theory, with K_G from the internal forces of q. The
/// outcome is `singular` if the model buckles below the full load. The outcome is `not_converged`
/// if no equilibrium was found beyond the load factor that the reason states. The error of the
/// state includes the round-off error of the internal forces and the error of the last iteration.
///
/// The method follows the equilibrium path from the unloaded state. If fixed-point iteration with K
/// + K_G does not converge under the full load, the load is applied in steps. The state is stable
/// in each step: K + K_G has no negative pivot (Sylvester's law of inertia).
/// @param system  assembled model.
/// @param linear  solution of K q = f.
/// @param counters  incremented by the factorizations and solves.
[[nodiscard]] StaticState solve_second_order(const System& system, const Eigen::VectorXd& linear,
                                             Counters& counters);

}  // namespace trammel::solver
