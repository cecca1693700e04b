#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linalg/factorization.h"
#include "solver/motion/transient.h"

namespace trammel::solver {

/// Ratio of the smallest pivot to the diagonal below which a mass or stiffness matrix is treated as
/// singular.
inline constexpr double kSingularMass = 1e-13;

/// Returns a time span after the start of the motion in which the load has no jump or kink [s]. The
/// span is at most one time step.
[[nodiscard]] double smooth_load_interval(const std::vector<double>& breakpoints,
                                          const TransientOptions& options);

/// Computes a quasi-static start. K q = f is solved at the start and at four later times, within a
/// step and before a jump or kink of the load. The velocity v follows from the one-sided finite
/// difference of order 4. Then K q = f - C v is solved at the start. Without this solution, the
/// damping forces C v would start suddenly and excite vibrations of stiff members.
/// @returns singular if K is singular.
[[nodiscard]] Outcome start_quasi_statically(EquationMatrices& matrices,
                                             const TransientOptions& options, Eigen::VectorXd& q,
                                             Eigen::VectorXd& v, Counters& counters);

/// Returns a failure if the time scheme is unstable with the given step at the highest natural
/// frequency. Power iteration approximates this frequency from below, so that all stable steps are
/// accepted.
[[nodiscard]] Outcome check_time_step_stability(const EquationMatrices& matrices,
                                                const TransientOptions& options,
                                                Counters& counters);

/// Massless coordinates in systems with constant matrices: directions z with M z = 0. The time
/// scheme does not determine their velocities. Undamped massless coordinates satisfy z^T (f - C v -
/// K q) = 0 at any time. Their velocities and accelerations follow from the time derivatives of
/// this equation. The velocities of damped massless coordinates balance the forces.
class MasslessCoordinates {
 public:
  /// Factors the sum of the mass matrix M and a small multiple of the matrix C or K. The multiple
  /// depends on the step h. It changes the motion of masses in a step only by a fraction of 1e-16.
  /// The matrices must outlive this object.
  /// @returns false if a massless coordinate has neither stiffness nor damping.
  [[nodiscard]] bool factor(const EquationMatrices& matrices, double h, Counters& counters);
  /// Moves massless coordinates to equilibrium at the start of a segment between breakpoints, and
  /// computes all accelerations. `df_dt` is the time derivative of the load [SI/s].
  void equilibrate(TransientState& state, const Eigen::VectorXd& df_dt);
  /// Computes velocities and accelerations of massless coordinates from their positions and from
  /// the time derivative of the load.
  void set_rates_from_positions(TransientState& state, const Eigen::VectorXd& df_dt);

 private:
  /// Adds a motion z of massless coordinates to x such that z^T (residual - B z) = 0. B is C if the
  /// massless coordinates are damped, and K otherwise.
  void add_balancing_motion(const Eigen::VectorXd& residual, Eigen::VectorXd& x);
  void accelerate(TransientState& state, const Eigen::VectorXd& df_dt);

  const EquationMatrices* matrices_ = nullptr;
  Counters* counters_ = nullptr;
  // Factorization of M + share B, where B is C or K.
  SparseLdlt factor_{SparseLdlt::Triangle::mean};
  bool factored_ = false, damped_ = false;
  double step_ = 0, share_ = 0;
  Eigen::VectorXd s_, w_;
};

}  // namespace trammel::solver
