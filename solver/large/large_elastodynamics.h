#pragma once

#include <functional>
#include <vector>

#include "solver/large/geometrically_exact_system.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_element.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::solver {

/// Solves elastodynamics with large displacement in the geometrically exact tier (solver/large).
/// Vibration and start are as in `solve_elastodynamics`:
///
/// - Actuators follow the path exactly. The relative rotation at welded or sprung joints is driven
///   as in the nominal motion, in which the links are free of stress.
/// - Without elastic inertia, each sample is an equilibrium under loads, weight and nominal
///   inertia.
/// - Displacements are relative to the nominal position. Section forces refer to the axes of the
///   rotated sections.
/// - Stresses, energies, numbers of effects, and a quasi-static motion in addition to a dynamic one
///   are not available.
/// - Gyroscopic terms are always included.
/// - Schemes are replaced by generalized-alpha with the same spectral radius at infinite frequency.
/// - Steps end at sample times and at bends of the load history.
/// - A quasi-static start computes the rates of the deflection from three equilibria. The first
///   equilibrium is then corrected for damping at these rates.
///
/// The outcome is not_converged if a path of equilibria or a step fails.
/// @throws ModelError  as `solve_elastodynamics`; if `beyond_large_displacement` returns a reason;
///   or without elastic inertia if there are no sample times.
[[nodiscard]] ElastodynamicsSolution solve_large_elastodynamics(
    const ElastodynamicsOptions& options);

/// Returns the reason why `solve_large_elastodynamics` does not support a motion, or null.
/// @param options  motion.
/// @param model  manipulator at the start of the motion.
[[nodiscard]] const char* beyond_large_displacement(const ElastodynamicsOptions& options,
                                                    const Model& model);

}  // namespace trammel::solver

/// Joint motions of the rigid manipulator on its path, as prescribed functions of time of drives.
namespace trammel::solver::large_motion {

/// Returns the rigid motion at a time.
using RigidMotion = std::function<const InverseDynamics&(double)>;

/// Returns the rigid motion with a cache of the last evaluation. All joints and all corrections of
/// a step request the same time.
[[nodiscard]] RigidMotion cached_motion(std::function<InverseDynamics(double)> evaluate);

/// Returns the rotation of a part since `start` relative to another part or the ground (-1) [rad],
/// including full turns. It is followed from the last request in increments of 0.5 rad. The
/// function continues beyond the ends of the path with the acceleration and its rate there. The
/// solver requires this for differences about the first and last times.
/// @param motion  rigid motion.
/// @param path  path of the platform.
/// @param start  time with zero rotation [s].
/// @param part  index in `InverseDynamics::q`: proximal links 0 to 2, distal links 3 to 5, platform
///   8.
/// @param from  reference part, or -1.
[[nodiscard]] TimeFunction joint_law(const RigidMotion& motion, const Path& path, double start,
                                     Index part, Index from = -1);

/// Additional node at a joint for the end of a distal link. Its rotation is driven relative to the
/// node of the joint.
struct DrivenEnd {
  Index node = 0, beside = 0;
  Index part = 0, from = 0;  ///< indices in `InverseDynamics::q`
  std::size_t member = 0;
};

/// Returns rates of the coordinates if all parts move rigidly: velocities (order 1) or
/// accelerations (order 2).
/// @param system  equations.
/// @param motion  nominal motion.
/// @param order  1 or 2.
/// @param ends  the last nodes of the model; the builder created the others.
[[nodiscard]] VectorXd nominal_rates(const GeometricallyExactSystem& system,
                                     const NominalMotion& motion, int order,
                                     const std::vector<DrivenEnd>& ends = {});

}  // namespace trammel::solver::large_motion
