#pragma once

#include <functional>
#include <vector>

#include "solver/large/geometrically_exact_system.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_element.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::solver {

/// Solves the elastodynamics of a manipulator with large displacement by the geometrically exact
/// theory (solver/large). Options and results are those of `solve_elastodynamics`, except:
///
/// - Actuators follow the path exactly. The relative rotation at welded or sprung joints is driven
///   as in the nominal motion, in which the links are free of stress.
/// - Without elastic inertia, each sample is an equilibrium under loads, weight and nominal
///   inertia.
/// - Displacements are relative to the nominal position. Section forces refer to the axes of the
///   rotated sections.
/// - Stresses, energies, dimensionless numbers of effects, and a quasi-static motion in addition to
///   a dynamic one are not available.
/// - Gyroscopic terms are always included.
/// - Time schemes are replaced by generalized-alpha with the same spectral radius at infinite
///   frequency.
/// - Time steps end at sample times and at kinks of the load history.
/// - A quasi-static start computes the rates of the deflection from the equilibria at three times.
///   The first equilibrium is then corrected for the damping forces at these rates.
///
/// The outcome is not_converged if a path of equilibria or a step fails.
/// @throws ModelError  as `solve_elastodynamics`; if `reason_no_large_displacement` returns a
///   reason; or if there are neither elastic inertia nor sample times.
[[nodiscard]] ElastodynamicsSolution solve_large_elastodynamics(
    const ElastodynamicsOptions& options);

/// Returns the reason why `solve_large_elastodynamics` does not support a motion, or null if the
/// motion is supported. `model` is the manipulator at the start of the motion.
[[nodiscard]] const char* reason_no_large_displacement(const ElastodynamicsOptions& options,
                                                       const Model& model);

}  // namespace trammel::solver

/// Joint rotations of the rigid manipulator on its path. Drives prescribe these rotations as
/// functions of time.
namespace trammel::solver::large_motion {

/// Function that returns the motion of the rigid manipulator at a time.
using RigidMotion = std::function<const InverseDynamics&(double)>;

/// Adds a cache of the last evaluation to a function for the rigid motion. The cache saves time,
/// because all joints and all corrections of a step request the motion at the same time.
[[nodiscard]] RigidMotion cached_motion(std::function<InverseDynamics(double)> evaluate);

/// Returns the rotation of a link or of the platform since the time `start` as a function of time.
/// The rotation [rad] includes full turns and is relative to the body `reference_part` or the
/// ground (-1). Bodies are indices in `InverseDynamics::q`: proximal links 0 to 2, distal links 3
/// to 5, platform 8. To count full turns, the rotation is followed from the last requested time in
/// increments of at most 0.5 rad. Beyond the ends of the path, the rotation is extrapolated with
/// the acceleration and the rate of the acceleration at the end. Central differences in time at the
/// first and last times of the path require values beyond its ends.
[[nodiscard]] TimeFunction joint_rotation_law(const RigidMotion& motion, const Path& path,
                                              double start, Index part, Index reference_part = -1);

/// Additional node at a joint for the end of a distal link. The rotation of this node is driven
/// relative to the node of the joint.
struct DrivenEnd {
  Index node = 0, beside = 0;
  Index part = 0, from = 0;  ///< indices of link and joined body in `InverseDynamics::q`
  std::size_t member = 0;
};

/// Returns rates of the coordinates if all links and the platform move rigidly: velocities (order
/// 1) or accelerations (order 2). The nodes of the driven `ends` are the last nodes of the model.
[[nodiscard]] VectorXd nominal_motion_derivative(const GeometricallyExactSystem& system,
                                                 const NominalMotion& motion, int order,
                                                 const std::vector<DrivenEnd>& ends = {});

}  // namespace trammel::solver::large_motion
