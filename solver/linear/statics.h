#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct StaticsOptions {
  /// true: second-order theory, (K + K_G) q = f. K_G is the geometric stiffness matrix of the
  /// internal forces of the solution q. Tension stiffens, and compression softens
  /// (geometric_stiffness.h).
  bool second_order = false;
};

/// Result of statics, K q = f (Varalakshmi & Srinivas 2017, Eq. 11). Section forces N, V, M act on
/// a face whose normal points from the first to the second node of a member. The x axis points
/// along the member and the y axis to the left of x. Tension is positive:
///
///   \f[ EI\, v'' = M, \quad dM/dx = -V, \quad dV/dx = -q_y, \quad dN/dx = -q_x. \f]
struct StaticSolution {
  Outcome outcome;  ///< singular: the reason describes the zero-energy mode
  /// Free coordinates; `node_motion` converts them to node displacements.
  Eigen::VectorXd q;
  /// Internal forces of q; only computed in second-order theory.
  Prestress forces;
  /// Factor by which the loads amplify the second-order displacement: elastic stiffness over
  /// stiffness under load [-].
  double amplification = 1;
  /// Estimated number of correct digits of the largest displacement, from StaticState::error.
  double estimated_correct_digits = 0;
  /// Displacements of the model nodes, one row (ux [m], uy [m], rotation [rad]) per node. The
  /// rotation is NaN for a node without rotation.
  Eigen::MatrixX3d displacement;
  /// Rotations of member ends, member x (first end, second end) [rad].
  Eigen::MatrixX2d end_rotation;
  /// Reactions (forces of the ground on the nodes), one row (Fx, Fy [N], moment [N m]) per support.
  Eigen::MatrixX3d reaction;
  /// Section forces at the first node, member x (N [N], V [N], M [N m]).
  Eigen::MatrixX3d resultant_start;
  /// Section forces at the second node, member x (N [N], V [N], M [N m]).
  Eigen::MatrixX3d resultant_end;
  /// Largest |N|/A + |M|/W along each member [Pa].
  Eigen::VectorXd member_stress;
  /// Stresses at the centroid, triangle x (sxx, syy, sxy) [Pa].
  Eigen::MatrixX3d triangle_stress;
  /// Nodal stresses, one row (sxx, syy, sxy) [Pa] per model node. The nodal stress is the
  /// area-weighted mean of the stresses of the adjacent triangles at the node. Nodes without
  /// triangles have NaN.
  Eigen::MatrixX3d node_stress;
  /// Norm of the sum of reactions and loads [N].
  double equilibrium_residual = 0;
  /// Magnitude of the moment of all reactions and loads about the world origin [N m].
  double moment_residual = 0;
  /// Residuals of the equation that was solved, of linear or second-order theory.
  Evidence evidence;
  Counters counters;
};

[[nodiscard]] StaticSolution solve_statics(const System& system,
                                           const StaticsOptions& options = {});

/// State of the model, with displacements and loads from which forces and stresses are computed.
struct ElasticState {
  Eigen::VectorXd u;         ///< displacements of the unconstrained coordinates [m, rad]
  double load_factor = 1;    ///< factor of all loads except weight
  double weight_factor = 1;  ///< factor of the weight
  /// Accelerations of the unconstrained coordinates. They include the mass-proportional damping
  /// forces divided by the mass. The vector is empty in a state at rest.
  Eigen::VectorXd acceleration;
  /// Internal forces of second-order theory; null for linear theory.
  const Prestress* prestress = nullptr;
  /// Result of `constraint_multipliers`; empty if not yet computed.
  Eigen::VectorXd constraint_forces;
};

/// Returns the loads of a state on the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd acting_load(const System& system, const ElasticState& state);
/// Returns the load of a state along a frame element, in world axes [N/m].
[[nodiscard]] Vector2d acting_line_load(const System& system, const ElasticState& state,
                                        const FrameElement& element);

/// Forces of the nodes on each frame element in element axes, one column per element. The rows are
/// axial force, transverse force and moment at the first node, then at the second node [N, N, N m].
using ElementForces = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Displacements of a state, and its forces on the frame elements and constraint forces from
/// linear, second-order or geometrically exact theory.
struct RecoveredForces {
  const std::vector<Vector2d>& position;  ///< positions of the mesh nodes, model nodes first [m]
  const Eigen::VectorXd& u;               ///< unconstrained coordinates [m, rad]
  const Constraints& constraints;
  /// Lagrange multipliers of the constraint rows [N, N m].
  Eigen::VectorXd multipliers;
  ElementForces element;
};

/// Magnitudes of forces [N] and moments [N m] below which forces and moments of a state are
/// round-off errors.
struct ForceRoundoff {
  double force = 0, moment = 0;
};
/// Returns the limits below which forces and moments of a state are round-off errors.
/// @param ends  forces of the nodes on the frame elements.
/// @param size  size of the model [m].
[[nodiscard]] ForceRoundoff force_roundoff(const ElementForces& ends, double size);

/// Returns force over area, or moment over section modulus [Pa]. If the section has no area or
/// modulus, the result is 0 for a force within `roundoff` and NaN for a larger force.
template <class T>
[[nodiscard]] double stress_of_force(const T& force, double area_or_modulus, double roundoff) {
  const double size = std::abs(force), stress = size / area_or_modulus;
  if (std::isfinite(stress)) return stress;
  return size <= roundoff ? 0 : std::numeric_limits<double>::quiet_NaN();
}

/// Computes displacements, rotations of member ends, reactions, section forces and member stresses.
/// The largest stress is searched at the ends of each element and between the ends. Within an
/// element, the section forces follow from the end forces and from a uniform load that balances the
/// end forces.
void set_displacements_and_forces(const System& system, const RecoveredForces& forces,
                                  StaticSolution& solution);

/// Sum of forces, sum of moments about the origin, and sums of the magnitudes of all terms.
struct ForceSum {
  /// Sum of forces [N].
  Vector2d force = Vector2d::Zero();
  /// Sum of moments about the origin [N m].
  double moment = 0;
  /// Sums of the magnitudes of forces [N] and of moments [N m].
  Vector2d terms = Vector2d::Zero();

  void add(const Vector2d& at, const Vector2d& f, double m);
};
/// Sums the loads on the unconstrained coordinates and the reactions of supports.
/// @param system  assembled model.
/// @param position  positions of the mesh nodes [m].
/// @param load  loads on the unconstrained coordinates [N, N m].
/// @param solution  solution that contains the reactions.
[[nodiscard]] ForceSum sum_forces(const System& system, const std::vector<Vector2d>& position,
                                  const Eigen::VectorXd& load, const StaticSolution& solution);

/// Returns the Lagrange multipliers of the constraint rows [N, N m]: forces of supports, rigid
/// bodies and inextensible members. The constraint forces balance elastic forces, inertia forces
/// and loads.
[[nodiscard]] Eigen::VectorXd constraint_multipliers(const System& system,
                                                     const ElasticState& state);

/// Returns the forces of the nodes on the frame elements in a state: k u + k_G u + m a - f. The
/// element matrices are stiffness k, geometric stiffness k_G and mass m, and f is the load.
[[nodiscard]] ElementForces end_forces(const System& system, const ElasticState& state);

/// Returns the column of `StaticSolution::reaction` for a constraint row of a support.
[[nodiscard]] Index support_component(const System& system, const ConstraintRow& row);

/// Computes displacements, forces, stresses and residuals. In a state with acceleration, section
/// forces and reactions include inertia forces. The equilibrium residuals do not include inertia
/// forces.
void postprocess(const System& system, const ElasticState& state, StaticSolution& solution);

/// Returns the largest imbalance of the reported forces at any coordinate, relative to `terms`. The
/// reported forces are section forces at member ends, forces of springs and triangles, reactions,
/// forces of other constraints, and nodal loads. This check only confirms that the forces follow
/// from the state. The result is small even if the state does not solve the equation of statics.
/// @param system  assembled model.
/// @param state  displacements, loads and accelerations.
/// @param solution  solution that contains the reported forces.
/// @param terms  sums of the magnitudes of K u and the loads on the unconstrained coordinates.
[[nodiscard]] double largest_relative_imbalance(const System& system, const ElasticState& state,
                                                const StaticSolution& solution,
                                                const Eigen::VectorXd& terms);

}  // namespace trammel::solver
