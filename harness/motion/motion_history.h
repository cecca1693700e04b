#pragma once

#include <vector>

#include "harness/input/json_view.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/statics.h"
#include "solver/model/evidence.h"
#include "solver/motion/transient.h"

namespace trammel::harness {

/// The motion of a model at its sample times.
struct MotionHistory {
  solver::Outcome outcome;
  solver::Evidence evidence;
  solver::Counters counters;
  std::vector<double> time;         ///< [s]
  std::vector<double> load_factor;  ///< of the loads, not weight, at those times
  /// Of the loads and of the weight, what strains follow late where damping is in proportion to
  /// stiffness: 2 x time; else empty.
  Eigen::MatrixXd followed_factor;
  Eigen::MatrixXd q, v, a;         ///< free coordinate x time
  solver::ViscousDamping damping;  ///< that it has
  std::int64_t steps = 0;          ///< of the integrator; 0 for superposed modes
};

/// As the key "transient" of the analysis says, damped where the effects have it.
/// @throws InputError  for a history or damping without meaning.
[[nodiscard]] MotionHistory compute_motion(const JsonView& transient, const solver::System& system,
                                           solver::Effects effects);

/// Part of the initial velocity that a reduced basis cannot represent, relative to the initial
/// velocity of the full model, in the norm of kinetic energy [-]; 0 without an initial velocity.
[[nodiscard]] double unrepresented_velocity(const JsonView& transient, const solver::System& full,
                                            const solver::System& reduced);

}  // namespace trammel::harness
