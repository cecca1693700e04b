#pragma once

#include <functional>
#include <utility>

#include "solver/large_motion/elements/large_motion_model.h"
#include "solver/manipulator/inverse_dynamics.h"

/// Joints of the rigid manipulator on its path, as laws for drives in large motion.
namespace trammel::solver::large_motion {

/// First and last time of a path [s].
[[nodiscard]] std::pair<double, double> time_limits(const Path& path);

/// The rigid manipulator at a time.
using RigidMotion = std::function<const InverseDynamics&(double)>;

/// Several joints and every correction of a step ask for one time: it is reckoned once.
[[nodiscard]] RigidMotion once_per_time(std::function<InverseDynamics(double)> reckon);

/// How far a part has turned since `start`, as seen from another part or the ground (-1), whole
/// turns and all [rad]: from where it was asked for last it is followed in turns of 0.5 rad. It
/// goes on beyond the ends of the path, with the acceleration and its rate there: the solver takes
/// differences about the first instant and the last.
/// @param part, from  as in `InverseDynamics::q`: proximal links 0 to 2, distal links 3 to 5,
/// platform 8
[[nodiscard]] TimeFunction joint_law(const RigidMotion& motion, const Path& path, double start,
                                     Index part, Index from = -1);

}  // namespace trammel::solver::large_motion
