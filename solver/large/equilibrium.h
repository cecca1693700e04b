#pragma once

#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/statics.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

/// Options of Newton's method.
struct NewtonOptions {
  int max_iterations = 30;
  /// Limit of the last Newton correction, relative to the displacement [-].
  double tolerance = 1e-13;
  /// Relative change of the state above which the tangent is factored again [-].
  double same_state = 1e-7;
};

/// Function that returns the change of the load factor in a Newton iteration, or a value that is
/// not finite to stop the iteration. Its arguments are the Newton correction at a fixed load
/// factor, and the derivative d(q, lambda)/dload.
using LoadControl = std::function<double(const VectorXd& correction, const VectorXd& load_step)>;

/// Result of Newton's method. Each list has one entry per iteration.
struct NewtonResult {
  Outcome outcome;
  /// Root mean square of the Newton correction in each iteration [-]; translations are divided by
  /// the model size.
  std::vector<double> correction;
  /// Norm of the residual of equilibrium in each iteration [N m]; forces are multiplied by the
  /// model size.
  std::vector<double> force_residual;
  std::vector<double>
      constraint_residual;  ///< residual of the constraints and of stretch and shear of beams [m]
};

/// Solver of static equilibrium by Newton's method with exact tangents. An object reuses its memory
/// from one solution to the next.
class Equilibrium {
 public:
  explicit Equilibrium(const GeometricallyExactSystem& system, const NewtonOptions& options = {});

  /// Adds the damping forces at the velocities of a state, as constant loads, to all following
  /// equilibria.
  void freeze_damping_forces(const State& moving);

  /// Computes the equilibrium at the load factor `load_factor` by Newton's method with the start
  /// value `state`. Drives are evaluated at the time `load_factor`. `control` may change the load
  /// factor. If the method fails, `state` is unchanged.
  [[nodiscard]] NewtonResult solve(State& state, double load_factor,
                                   const LoadControl& control = {});

  /// Factors the tangent matrix at a state. @return false if the matrix is singular to working
  /// precision.
  [[nodiscard]] bool factorize_tangent(const State& state);
  /// Factors the tangent matrix at a state. The last factorization is kept if its state differs
  /// from `state` by at most `relative` times the size of `state`.
  [[nodiscard]] bool factor_if_moved(const State& state, double relative);
  /// Computes the derivatives of displacements q and multipliers lambda with respect to the load
  /// factor, `direction` = (dq/dload, dlambda/dload), with the last factored tangent matrix.
  void load_factor_sensitivity(const State& state, VectorXd& direction);
  /// Computes one Newton correction `step`, which solves: tangent matrix * step = -residual. Norms
  /// of the residual and of the correction are appended to `history`.
  void newton_correction(const State& state, VectorXd& step, NewtonResult& history);
  /// Returns the largest backward error |r| / (|K| |x| + |load|) of all rows in a state. r is the
  /// residual of equilibrium and constraints, x the unknowns, and K a newly assembled tangent.
  [[nodiscard]] double backward_error(const State& state);
  /// Returns the smallest absolute eigenvalue of the scaled tangent matrix [N m], and sets `shape`
  /// to its mode shape. The eigenvalue is computed by inverse iteration with the last
  /// factorization.
  double smallest_eigenpair(VectorXd& shape);

  /// Motion for which the last tangent matrix has no stiffness: its strain energy is within the
  /// round-off error of the terms of this energy.
  struct FreeMotion {
    bool exists = false;
    bool is_driven = false;  ///< true: the loads do work on the motion
    VectorXd shape;          ///< mode shape of the smallest eigenvalue, also without free motion
    Index coordinate = 0;    ///< coordinate with the largest motion in `shape`
    double stiffness = 0;    ///< typical stiffness of `coordinate` [N/m or N m/rad]
  };
  /// Checks if the mode of the smallest eigenvalue of the last tangent matrix is a free motion.
  [[nodiscard]] FreeMotion free_motion(const State& state);
  /// Fixes a coordinate in all following tangent matrices by an additional stiffness. A member or
  /// body that can move freely therefore remains in place if no force acts along its free motion.
  /// The free motion is then not counted as an unstable direction.
  void restrain_coordinate(Index coordinate, double stiffness) {
    held_.emplace_back(coordinate, stiffness);
    factored_ = State();
  }

  /// Returns true if Newton's method has converged for a displacement of the given size. The method
  /// has converged if the last correction is small enough, or if the corrections stagnate at the
  /// level of round-off errors.
  [[nodiscard]] bool converged(const std::vector<double>& correction, double displacement) const;
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }

 private:
  /// Computes the residual of equilibrium and of the constraint rows. The residual of a constraint
  /// row g is g - C lambda, plus tau dg/dt if the row is elastic.
  void residual_of(const State& state, Eigen::Ref<VectorXd> residual);

  const GeometricallyExactSystem& system_;
  NewtonOptions options_;
  KktMatrix matrix_;
  VectorXd constraint_residual_, constraint_rate_, step_, load_step_;
  State factored_;         ///< state of the last factored tangent
  VectorXd held_damping_;  ///< damping forces of `freeze_damping_forces`; may be empty
  std::vector<std::pair<Index, double>> held_;  ///< restrained coordinates, additional stiffness
  VectorXd force_unit_;                         ///< unit of each multiplier: 1/m or 1/rad
};

/// Adds a correction (dq, dlambda) times a factor to a state.
void apply_correction(State& state, const VectorXd& step, double factor = 1);

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

/// Adds the element evaluations of `tangents` assembled tangent matrices to the counters of the
/// effects, such as shear or gravity. `moving` is true if the tangent matrices include masses.
void count_element_evaluations(const large_motion::GeometricallyExactSystem& system,
                               std::int64_t tangents, bool moving, Counters& counters);

/// Solves statics with large displacement by the geometrically exact theory. The load is applied in
/// steps of automatic size. The outcome is not_converged if the path of equilibria does not reach
/// the full load.
/// @throws ModelError  if the model is invalid.
[[nodiscard]] StaticSolution solve_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

/// Solves statics with large displacement to six digits. Residuals that support the solution
/// (`Evidence`) are not computed. All Newton corrections use the tangent of the unloaded model. If
/// the corrections decrease too slowly, or the number of unstable directions changes, the function
/// calls `solve_large_statics`.
[[nodiscard]] StaticSolution estimate_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

}  // namespace trammel::solver
