#pragma once

#include <functional>
#include <vector>

#include "solver/large/geometrically_exact_system.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_element.h"
#include "solver/manipulator/rigid_dynamics.h"

namespace trammel::solver {

/// Elastodynamics with large displacement, in the geometrically exact tier (solver/large_motion):
/// what vibrates and how it starts as in `solve_elastodynamics`. Actuators follow the path exactly;
/// where a joint is welded or sprung, one link's turn against the other is driven as in the nominal
/// motion, in which nothing is stressed. Without elastic inertia every sample is an equilibrium
/// under loads, weight and nominal inertia. Displacements are from the nominal position, section
/// forces along the axes of the rotated sections; there are no stresses, energies and numbers of
/// effects, and no quasi-static motion beside a dynamic one. Gyroscopic terms cannot be left out.
/// Schemes become generalized-alpha with their spectral radius at infinite frequency. Steps end
/// where samples are asked for and the load history bends. A quasi-static start: three equilibria
/// give the rates of the deflection; the first is moved to where it holds with what damping takes
/// up at them.
/// not_converged: a path of equilibria or a step that does not reach its end.
/// @throws ModelError  as `solve_elastodynamics`; where it is `beyond_large_displacement`; without
///                     elastic inertia and times of samples.
[[nodiscard]] ElastodynamicsSolution solve_large_elastodynamics(
    const ElastodynamicsOptions& options);

/// What of a motion `solve_large_elastodynamics` does not know; null where it knows all.
/// @param model  of the manipulator where the motion starts.
[[nodiscard]] const char* beyond_large_displacement(const ElastodynamicsOptions& options,
                                                    const Model& model);

}  // namespace trammel::solver

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
/// @param ends  the last nodes of the model; the others are the builder's.
[[nodiscard]] VectorXd nominal_rates(const GeometricallyExactSystem& system,
                                     const NominalMotion& motion, int order,
                                     const std::vector<DrivenEnd>& ends = {});

}  // namespace trammel::solver::large_motion
