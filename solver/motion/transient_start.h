#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linalg/factorization.h"
#include "solver/motion/transient.h"

namespace trammel::solver {

/// Below this ratio of pivot to diagonal a mass or stiffness matrix counts as singular.
inline constexpr double kSingularMass = 1e-13;

/// At most a step, within which the load has no jump or kink [s].
[[nodiscard]] double smooth_span(const std::vector<double>& breakpoints,
                                 const TransientOptions& options);

/// K q = f now and at four times after it, within a step and before a jump or kink of the load: the
/// velocity by the one-sided difference of order 4.
/// Then K q = f - C v: otherwise the drag of that velocity would set in at once, and shake what
/// is stiff.
/// @param q, v  at options.start
/// @returns singular where K is.
[[nodiscard]] Outcome start_quasi_statically(EquationMatrices& matrices,
                                             const TransientOptions& options, Eigen::VectorXd& q,
                                             Eigen::VectorXd& v, Counters& counters);

/// Refuses a step at which the fastest motion grows. The power iteration comes from below, so
/// that it refuses no stable step.
[[nodiscard]] Outcome check_stability(const EquationMatrices& matrices,
                                      const TransientOptions& options, Counters& counters);

/// Coordinates without mass, directions z with M z = 0, of constant matrices: no step says how fast
/// they move. Undamped they are at once where the forces on them balance, z^T (f - C v - K q) = 0,
/// and move as that and its derivatives in time do; damped, their velocity balances the forces.
class MasslessCoordinates {
 public:
  /// @param h  the step: masses move by 1e-16 of what they do in it.   @pre the matrices outlive
  /// this
  /// @returns false where such a coordinate has neither stiffness nor damping.
  [[nodiscard]] bool factor(const EquationMatrices& matrices, double h, Counters& counters);
  /// Puts them where they belong at the start of a segment, and finds all accelerations.
  /// @param rate  df/dt [SI/s]
  void settle(TransientState& state, const Eigen::VectorXd& rate);
  /// Their velocities and accelerations in a state whose positions are known.
  void follow(TransientState& state, const Eigen::VectorXd& rate);

 private:
  /// x + z, so that z^T (residual - B z) = 0 with B = C where they are damped, K where not.
  void balance(const Eigen::VectorXd& residual, Eigen::VectorXd& x);
  void accelerate(TransientState& state, const Eigen::VectorXd& rate);

  const EquationMatrices* matrices_ = nullptr;
  Counters* counters_ = nullptr;
  SparseLdlt factor_{SparseLdlt::Triangle::mean};  // of M + share B
  bool factored_ = false, damped_ = false;
  double step_ = 0, share_ = 0;
  Eigen::VectorXd s_, w_;
};

}  // namespace trammel::solver
