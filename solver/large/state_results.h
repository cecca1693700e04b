#pragma once

#include <Eigen/Core>

#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/statics.h"

/// Results of a state for nodes, members, supports and drives of the model, in the order and with
/// the signs of `StaticSolution`.
namespace trammel::solver::large_motion {

/// Returns displacements, velocities or accelerations of the model nodes: one row per node, with
/// columns x, y, rotation. The rotation is NaN for a node without rotation.
[[nodiscard]] Eigen::MatrixX3d node_motion(const GeometricallyExactSystem& system,
                                           const VectorXd& values);

/// Returns the forces of the ground on the supported nodes, including inertia: one row per support,
/// with columns Fx, Fy [N], moment [N m]. If several supports hold the same coordinate, each row
/// contains the full reaction of this coordinate.
[[nodiscard]] Eigen::MatrixX3d reactions(const GeometricallyExactSystem& system,
                                         const State& state);

/// Returns a state in the form of `solve_statics`: displacements, end rotations, reactions, and
/// section forces along the axes of the rotated sections.
[[nodiscard]] StaticSolution static_solution(const GeometricallyExactSystem& system,
                                             const State& state);

/// Residual of the equilibrium of each member as a free body in the deformed position. The forces
/// on a member are the section forces at both ends, loads, weight and inertia forces.
class MemberBalance {
 public:
  /// Adds the residuals of the equilibrium of all members in a state that satisfies the equation of
  /// motion.
  void add_state(const GeometricallyExactSystem& system, const State& state);
  /// Returns the largest resultant force, or moment about the first end, of all members and states.
  /// The result is relative to the largest sum of the magnitudes of these forces or moments.
  /// Members whose forces are only round-off errors therefore do not contribute.
  [[nodiscard]] double residual() const;

 private:
  double force_ = 0, moment_ = 0;              // largest resultants [N, N m]
  double force_terms_ = 0, moment_terms_ = 0;  // largest sums of magnitudes [N, N m]
  double length_ = 0;                          // length of the longest member [m]
};

/// Returns the force [N] or torque [N m] of a drive on the structure.
[[nodiscard]] double drive_force(const GeometricallyExactSystem& system, const State& state,
                                 Index drive);

/// Returns the deformed positions of the element nodes of a member, from its first to its second
/// node: one row (x, y) per node [m].
[[nodiscard]] Eigen::MatrixX2d member_node_positions(const GeometricallyExactSystem& system,
                                                     const VectorXd& q, Index member);

/// Largest number of rigid constraints for which redundant constraints are counted. With more
/// constraints, the factorization that yields the rank of the constraints would require more time
/// than statics.
inline constexpr Index kMaxCountedConstraints = 400;

/// Returns the number of redundant rigid constraints in a state. Equilibrium leaves the same number
/// of constraint forces undetermined. The result is 0 if there are more than
/// `kMaxCountedConstraints`.
[[nodiscard]] Index redundant_constraint_count(const GeometricallyExactSystem& system,
                                               const State& state);

}  // namespace trammel::solver::large_motion
