#pragma once

#include <limits>
#include <optional>

#include "solver/large_motion/elements/constrained_system.h"

namespace trammel::solver::large_motion {

/// Largest residuals of the rigid constraints of a state.
struct ConstraintGaps {
  double position = 0, rate = 0;                    ///< [m or rad], [m/s or rad/s]
  double relative_position = 0, relative_rate = 0;  ///< over the model's size or 1 rad [-], [1/s]
};

/// Residuals of the state at the end of a step, evaluated again.
class MotionResiduals {
 public:
  /// @pre the system outlives this
  explicit MotionResiduals(const ConstrainedSystem& system);

  /// Row by row over |M| |a| + |K| |q| + |G^T| |lambda|.
  /// @param residual  of the scheme's equation of motion
  [[nodiscard]] double equation_of_motion(const State& state, const VectorXd& residual);
  [[nodiscard]] ConstraintGaps constraints(const State& state);

 private:
  void add_terms(const TangentCoefficients& coefficients, const State& state);

  const ConstrainedSystem& system_;
  VectorXd row_unit_;  ///< of each constraint [m or rad]
  KktMatrix matrix_;
  VectorXd unknowns_, terms_, magnitudes_, constraint_residual_, constraint_rate_;
};

/// Orientation of a mechanism's assembly: the sign of det G, or of det (G, v) with one degree of
/// freedom. It differs between the branches that meet at a singular position, and a step that is
/// longer than the gap between two branches takes the wrong one, with residuals of round-off.
class AssemblyBranch {
 public:
  /// @pre the system outlives this
  explicit AssemblyBranch(const ConstrainedSystem& system);
  /// True if the orientation at the end of a step is the opposite of that at its start.
  [[nodiscard]] bool changes(const State& from, const State& to);

 private:
  /// 0 if it is not known, as at a singular position or at rest.
  [[nodiscard]] double orientation(const State& state);

  const ConstrainedSystem& system_;
  Index freedom_ = 0;
  double last_time_ = -std::numeric_limits<double>::infinity();
  double last_sign_ = 0;             ///< at the end of the last step that kept it
  std::optional<KktMatrix> matrix_;  ///< empty: the orientation is not known
};

}  // namespace trammel::solver::large_motion
