#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct StaticsOptions {
  /// Second-order theory: (K + K_G) q = f with the geometric stiffness of the forces that the
  /// solution has itself, so that tension stiffens and compression softens (see
  /// geometric_stiffness.h).
  bool second_order = false;
};

/// Statics K q = f (paper Eq. 11). Section forces N, V, M are those on a face whose normal points
/// from a member's first to its second node, x along it and y to its left: tension is positive,
/// EI v'' = M, dM/dx = -V, dV/dx = -q_y, dN/dx = -q_x.
struct StaticSolution {
  Outcome outcome;                      ///< singular: the reason names the free motion in words
  Eigen::VectorXd q;                    ///< free coordinates; see node_motion
  Prestress forces;                     ///< second-order theory: of q, those that hold it
  double amplification = 1;             ///< of what second-order theory adds, by the loads [-]
  double estimated_correct_digits = 0;  ///< of the largest displacement: second_order.h
  Eigen::MatrixX3d displacement;  ///< model node x (ux [m], uy [m], rotation [rad]); NaN rotation
                                  ///< where a node has none
  Eigen::MatrixX2d end_rotation;  ///< member x (first, second end) [rad]
  Eigen::MatrixX3d reaction;  ///< support x (Fx, Fy [N], moment [N m]) of the ground on the node
  Eigen::MatrixX3d resultant_start;  ///< member x (N [N], V [N], M [N m]) at its first node
  Eigen::MatrixX3d resultant_end;    ///< the same at its second node
  Eigen::VectorXd member_stress;     ///< largest |N/A| + |M|/W along each member [Pa]
  Eigen::MatrixX3d triangle_stress;  ///< triangle x (sxx, syy, sxy) at its centroid [Pa]
  /// Model node x (sxx, syy, sxy) [Pa]: mean of the stresses that its triangles have there, each
  /// weighted by its area; NaN at nodes without triangles.
  Eigen::MatrixX3d node_stress;
  double equilibrium_residual = 0;  ///< norm of reactions + loads [N]; the same for moments below
  double moment_residual = 0;       ///< about the world origin [N m]
  Evidence evidence;                ///< residuals of the state, in the theory solved
  Counters counters;
};

[[nodiscard]] StaticSolution solve_statics(const System& system,
                                           const StaticsOptions& options = {});

/// A state from which forces and stresses follow.
struct ElasticState {
  Eigen::VectorXd u;             ///< displacements of the unconstrained coordinates [m, rad]
  double load_factor = 1;        ///< of the loads but weight, which act in this state
  double weight_factor = 1;      ///< of the weight
  Eigen::VectorXd acceleration;  ///< of the same coordinates, damping in proportion to mass among
                                 ///< it; empty: at rest
  const Prestress* prestress = nullptr;  ///< second-order theory, where given
  Eigen::VectorXd constraint_forces;     ///< empty: not known yet
};

/// The loads that act in a state: on the unconstrained coordinates [N, N m], and along a frame
/// element, in world axes [N/m].
[[nodiscard]] Eigen::VectorXd acting_load(const System& system, const ElasticState& state);
[[nodiscard]] Vector2d acting_load(const System& system, const ElasticState& state,
                                   const FrameElement& element);

/// Forces that the nodes exert on each frame element, in its axes, one column per element; in turn
/// along, across and the moment at its first and at its second node [N, N, N m].
using ElementForces = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Forces on the frame elements and in the constraints of a state, by whatever theory.
struct RecoveredForces {
  const std::vector<Vector2d>& position;  ///< of the nodes of the mesh, the model's first [m]
  const Eigen::VectorXd& u;               ///< of the unconstrained coordinates [m, rad]
  const Constraints& constraints;
  Eigen::VectorXd multipliers;  ///< of the constraint rows [N, N m]
  ElementForces element;
};

/// Forces and moments of a state that are round-off [N, N m].
struct ForceRoundoff {
  double force = 0, moment = 0;
};
/// @param size  of the model [m]
[[nodiscard]] ForceRoundoff force_roundoff(const ElementForces& ends, double size);

/// Force over area or moment over section modulus: 0 for a force that is round-off if the section
/// does not state what resists it, NaN for any other there.
template <class T>
[[nodiscard]] double stress_of_force(const T& force, double resistance, double roundoff) {
  const double size = std::abs(force), stress = size / resistance;
  if (std::isfinite(stress)) return stress;
  return size <= roundoff ? 0 : std::numeric_limits<double>::quiet_NaN();
}

/// Fills displacements, rotations of members' ends, reactions, section forces and the stresses of
/// members: the largest at the ends of their elements and between them, where an element bears
/// evenly what the forces at its ends leave.
void recover(const System& system, const RecoveredForces& forces, StaticSolution& solution);

/// Sums of forces and of moments about the origin, and of the magnitudes of their terms.
struct ForceSum {
  Vector2d force = Vector2d::Zero();  ///< [N]
  double moment = 0;                  ///< [N m]
  Vector2d terms = Vector2d::Zero();  ///< [N], [N m]

  void add(const Vector2d& at, const Vector2d& f, double m);
};
/// Sums loads on the unconstrained coordinates and reactions of supports.
/// @param position  of the nodes of the mesh [m]
[[nodiscard]] ForceSum sum_forces(const System& system, const std::vector<Vector2d>& position,
                                  const Eigen::VectorXd& load, const StaticSolution& solution);

/// Multipliers of the constraint rows: the forces of supports, rigid bodies and inextensible
/// members, which balance elastic and inertia forces and the loads.
[[nodiscard]] Eigen::VectorXd constraint_forces(const System& system, const ElasticState& state);

/// Forces on the frame elements of a state: k u + k_G u + m a - f.
[[nodiscard]] ElementForces end_forces(const System& system, const ElasticState& state);

/// Column of `StaticSolution::reaction` that a support's constraint row belongs to.
[[nodiscard]] Index support_component(const System& system, const ConstraintRow& row);

/// Fills displacements, forces, stresses and residuals. With an acceleration, section forces hold
/// the inertia of their element; reactions and residuals do not.
void postprocess(const System& system, const ElasticState& state, StaticSolution& solution);

/// Equilibrium of what is reported: section forces at the ends of members, forces of springs and
/// triangles, reactions, forces of the other constraints, and the loads on nodes, at every
/// coordinate; the largest sum over `terms` there. Small also where the equation was not solved: it
/// tells whether the forces are those of the state.
/// @param terms  sums of the magnitudes of K u and the loads on the unconstrained coordinates
[[nodiscard]] double unbalanced_forces(const System& system, const ElasticState& state,
                                       const StaticSolution& solution,
                                       const Eigen::VectorXd& terms);

}  // namespace trammel::solver
