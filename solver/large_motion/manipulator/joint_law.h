#pragma once

#include <functional>
#include <vector>

#include "solver/elastodynamics/nominal_motion.h"
#include "solver/large_motion/system/geometrically_exact_system.h"
#include "solver/manipulator/inverse_dynamics.h"

/// Joints of the rigid manipulator on its path, as laws for drives in large motion.
namespace trammel::solver::large_motion {

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

/// A node beside that of a joint, on which the end of a distal link is; its turn is driven.
struct DrivenEnd {
  Index node = 0, beside = 0;
  Index part = 0, from = 0;  ///< of `InverseDynamics::q`
  std::size_t member = 0;
};

/// Rates of the coordinates where all parts move as rigid ones: velocities or accelerations, the
/// derivative of order 1 or 2.
/// @param ends  the last nodes of the model; the others are the builder's
[[nodiscard]] VectorXd nominal_rates(const GeometricallyExactSystem& system,
                                     const NominalMotion& motion, int order,
                                     const std::vector<DrivenEnd>& ends = {});

}  // namespace trammel::solver::large_motion
