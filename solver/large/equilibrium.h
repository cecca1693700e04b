#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/statics.h"
#include "solver/model/evidence.h"

namespace trammel::solver::large_motion {

struct NewtonOptions {
  int max_iterations = 30;
  double tolerance = 1e-13;  ///< last correction over the displacement [-]
  /// The tangent is factored again when the state has changed by more than this share [-].
  double same_state = 1e-7;
};

/// Change of the load factor in an iteration, not finite to stop: function of the correction at a
/// fixed load and of d(q, lambda)/dload.
using LoadControl = std::function<double(const VectorXd& correction, const VectorXd& load_step)>;

/// One Newton solution; each list has an entry an iteration.
struct NewtonResult {
  Outcome outcome;
  std::vector<double> correction;  ///< size of the correction: translations over the model's size
  std::vector<double> force_residual;  ///< of equilibrium, forces times the model's size [N m]
  std::vector<double>
      constraint_residual;  ///< of the constraints and of the beams' stretch and shear [m]
};

/// Static equilibrium by Newton's method with exact tangents. Its memory is reused by every solve.
class Equilibrium {
 public:
  explicit Equilibrium(const GeometricallyExactSystem& system, const NewtonOptions& options = {});

  /// What damping takes up at the velocities of a state acts on every state from here on.
  void hold_damping(const State& moving);

  /// Solves at `load` (also the time of drives), which `control` changes if it is given, from a
  /// start state. On failure the state stays as it was.
  [[nodiscard]] NewtonResult solve(State& state, double load, const LoadControl& control = {});

  /// Factors the tangent at a state. @return false: singular to working precision.
  [[nodiscard]] bool factor(const State& state);
  /// The same unless the tangent factored last is of a state that differs by that share at most.
  [[nodiscard]] bool factor_if_moved(const State& state, double relative);
  /// dq/dload and dlambda/dload with the tangent factored last, as (dq, dlambda).
  void load_direction(const State& state, VectorXd& direction);
  /// One corrector: solution of the tangent equation for minus the residual.
  void correction(const State& state, VectorXd& step, NewtonResult& history);
  /// Equilibrium and constraints of a state that is claimed, row by row, with the tangent formed
  /// afresh: |r| over (|K| |x| + |load|).
  [[nodiscard]] double backward_error(const State& state);
  /// Smallest eigenvalue (absolute) of the tangent over the squared scale, and its shape (by
  /// inverse iteration with the tangent factored last) [N m].
  double smallest_eigenpair(VectorXd& shape);

  /// A motion that the tangent factored last does not resist: its energy is the round-off error of
  /// its terms.
  struct FreeMotion {
    bool exists = false;
    bool is_driven = false;  ///< the loads do work on it
    VectorXd shape;          ///< of the smallest eigenvalue, whether it is free or not
    Index coordinate = 0;    ///< that moves most
    double stiffness = 0;    ///< typical of that coordinate [N/m or N m/rad]
  };
  [[nodiscard]] FreeMotion free_motion(const State& state);
  /// Keeps a coordinate in place from here on by a stiffness of the tangent alone: a free motion
  /// that no force drives stays where it is, and its direction is neither stable nor unstable.
  void hold(Index coordinate, double stiffness) {
    held_.emplace_back(coordinate, stiffness);
    factored_ = State();
  }

  /// True where the corrections so far end the iteration at a displacement of that size: the last
  /// is small enough, or they have stopped to shrink at round-off.
  [[nodiscard]] bool converged(const std::vector<double>& correction, double displacement) const;
  [[nodiscard]] const KktMatrix& matrix() const { return matrix_; }

 private:
  /// Forces, and g + tau dg/dt - C lambda with the rates of elastic rows.
  void residual_of(const State& state, Eigen::Ref<VectorXd> residual);

  const GeometricallyExactSystem& system_;
  NewtonOptions options_;
  KktMatrix matrix_;
  VectorXd constraint_residual_, constraint_rate_, step_, load_step_;
  State factored_;                              ///< of which the tangent was factored last
  VectorXd held_damping_;                       ///< empty: none
  std::vector<std::pair<Index, double>> held_;  ///< stiffness of coordinates of free motions
  VectorXd force_unit_;                         ///< of each multiplier: 1/m or 1/rad
};

/// Adds a correction (dq, dlambda) times a factor.
void apply_correction(State& state, const VectorXd& step, double factor = 1);

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

/// Adds the evaluations of the elements of so many tangents, by effect.
/// @param moving  with the masses.
void count_tangents(const large_motion::GeometricallyExactSystem& system, std::int64_t tangents,
                    bool moving, Counters& counters);

/// Statics in the geometrically exact tier (solver/large_motion). The load is put on in steps of
/// automatic size.
/// not_converged: the path of equilibria does not reach the load.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] StaticSolution solve_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

/// The same to six digits and without evidence: by corrections with the tangent of the model
/// without loads where these shrink fast and change no stability, else as above.
[[nodiscard]] StaticSolution estimate_large_statics(
    const Model& model, const large_motion::LargeMotionModel& large_motion = {});

}  // namespace trammel::solver
