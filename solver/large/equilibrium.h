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
  double tolerance = 1e-13;  ///< last correction relative to the displacement [-]
  /// Relative change of the state above which the tangent is factored again [-].
  double same_state = 1e-7;
};

/// Returns the change of the load factor in an iteration, or a value that is not finite to stop.
/// The arguments are the correction at a fixed load and d(q, lambda)/dload.
using LoadControl = std::function<double(const VectorXd& correction, const VectorXd& load_step)>;

/// Result of Newton's method. Each list has one entry per iteration.
struct NewtonResult {
  Outcome outcome;
  /// Size of the correction; translations relative to the model size.
  std::vector<double> correction;
  /// Residual of equilibrium; forces times the model size [N m].
  std::vector<double> force_residual;
  std::vector<double>
      constraint_residual;  ///< residual of the constraints and of stretch and shear of beams [m]
};

/// Static equilibrium by Newton's method with exact tangents. All solves reuse its memory.
class Equilibrium {
 public:
  explicit Equilibrium(const GeometricallyExactSystem& system, const NewtonOptions& options = {});

  /// Adds the damping forces at the velocities of a state, as constant loads, to all following
  /// equilibria.
  void hold_damping(const State& moving);

  /// Solves for the equilibrium at `load`, which is also the time of drives, from a start state.
  /// `control` may change the load. The state is unchanged on failure.
  [[nodiscard]] NewtonResult solve(State& state, double load, const LoadControl& control = {});

  /// Factors the tangent at a state. @return false if it is singular to working precision.
  [[nodiscard]] bool factor(const State& state);
  /// Factors the tangent unless the state of the last factorization differs by at most `relative`.
  [[nodiscard]] bool factor_if_moved(const State& state, double relative);
  /// Computes dq/dload and dlambda/dload with the last tangent, as (dq, dlambda).
  void load_direction(const State& state, VectorXd& direction);
  /// Computes one correction: the solution of the tangent equation for minus the residual.
  void correction(const State& state, VectorXd& step, NewtonResult& history);
  /// Returns the backward error of a state, |r| over (|K| |x| + |load|), row by row. It covers
  /// equilibrium and constraints, with a newly assembled tangent.
  [[nodiscard]] double backward_error(const State& state);
  /// Returns the smallest absolute eigenvalue of the tangent over the squared scale [N m], and its
  /// shape. It uses inverse iteration with the last factors.
  double smallest_eigenpair(VectorXd& shape);

  /// Motion without stiffness in the last tangent: its energy is within the round-off error of its
  /// terms.
  struct FreeMotion {
    bool exists = false;
    bool is_driven = false;  ///< the loads do work on the motion
    VectorXd shape;          ///< shape of the smallest eigenvalue, free or not
    Index coordinate = 0;    ///< coordinate with the largest motion
    double stiffness = 0;    ///< typical stiffness of that coordinate [N/m or N m/rad]
  };
  /// Checks the smallest eigenvalue of the last tangent for a free motion.
  [[nodiscard]] FreeMotion free_motion(const State& state);
  /// Fixes a coordinate in all following tangents by an additional stiffness. A free motion without
  /// driving force therefore remains in place, and its direction counts neither as stable nor as
  /// unstable.
  void hold(Index coordinate, double stiffness) {
    held_.emplace_back(coordinate, stiffness);
    factored_ = State();
  }

  /// Returns true if the corrections end the iteration at a displacement of that size. This is the
  /// case if the last correction is small enough, or if the corrections no longer decrease at the
  /// level of round-off.
  [[nodiscard]] bool converged(const std::vector<double>& correction, double displacement) const;
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }

 private:
  /// Computes forces, and g + tau dg/dt - C lambda with the rates of elastic rows.
  void residual_of(const State& state, Eigen::Ref<VectorXd> residual);

  const GeometricallyExactSystem& system_;
  NewtonOptions options_;
  KktMatrix matrix_;
  VectorXd constraint_residual_, constraint_rate_, step_, load_step_;
  State factored_;                              ///< state of the last factored tangent
  VectorXd held_damping_;                       ///< empty: no damping
  std::vector<std::pair<Index, double>> held_;  ///< coordinates of free motions and their stiffness
  VectorXd force_unit_;                         ///< unit of each multiplier: 1/m or 1/rad
};

/// Adds a correction (dq, dlambda) times a factor.
void apply_correction(State& state, const VectorXd& step, double factor = 1);

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

/// Adds the element evaluations of a number of tangent matrices to the counters of each effect.
/// @param system  equations.
/// @param tangents  number of tangents.
/// @param moving  true: tangents with masses.
/// @param counters  incremented.
void count_tangents(const large_motion::GeometricallyExactSystem& system, std::int64_t tangents,
                    bool moving, Counters& counters);

/// Solves statics in the geometrically exact tier (solver/large). The load is applied in steps of
/// automatic size. The outcome is not_converged if the path of equilibria does not reach the load.
/// @throws ModelError  if the model is invalid.
[[nodiscard]] StaticSolution solve_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

/// Solves statics to six digits and without evidence. It uses corrections with the tangent of the
/// unloaded model. If they decrease too slowly, or the stability changes, it calls
/// `solve_large_statics`.
[[nodiscard]] StaticSolution estimate_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

}  // namespace trammel::solver
