#pragma once

#include <Eigen/Core>

#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/statics.h"

/// What a state means at the model's own parts, in the order and the signs of `StaticSolution`.
namespace trammel::solver::large_motion {

/// Model node x (x, y, rotation) of coordinates, velocities or accelerations; NaN rotation where a
/// node has none.
[[nodiscard]] Eigen::MatrixX3d node_motion(const GeometricallyExactSystem& system,
                                           const VectorXd& values);

/// Support x (Fx, Fy [N], moment [N m]) of the ground on the node, inertia included. Supports that
/// hold one shared coordinate each show its whole reaction.
[[nodiscard]] Eigen::MatrixX3d reactions(const GeometricallyExactSystem& system,
                                         const State& state);

/// A state in the terms of `solve_statics`: displacements, end rotations, reactions, and section
/// forces along the axes of the rotated sections.
[[nodiscard]] StaticSolution static_solution(const GeometricallyExactSystem& system,
                                             const State& state);

/// How far members cut free are from equilibrium under the section forces at their ends, their
/// loads, weight and inertia in the place where they are.
class MemberBalance {
 public:
  /// @param state  meets the equation of motion.
  void add(const GeometricallyExactSystem& system, const State& state);
  /// The largest sum of forces, or of moments about a first end, over the largest terms of such
  /// sums: states and members whose forces are rounding of the others' do not count.
  [[nodiscard]] double residual() const;

 private:
  double force_ = 0, moment_ = 0;              // largest sums [N, N m]
  double force_terms_ = 0, moment_terms_ = 0;  // largest sums of magnitudes [N, N m]
  double length_ = 0;                          // the longest member [m]
};

/// Force [N] or torque [N m] of a drive on the structure.
[[nodiscard]] double drive_force(const GeometricallyExactSystem& system, const State& state,
                                 Index drive);

/// World positions of a member's element nodes, first to second node: point x (x, y) [m].
[[nodiscard]] Eigen::MatrixX2d member_node_positions(const GeometricallyExactSystem& system,
                                                     const VectorXd& q, Index member);

/// Above this number of rigid constraints, most of which are those of members, none are counted:
/// the factorization that finds their rank takes longer than statics.
inline constexpr Index kMaxCountedConstraints = 400;

/// Number of rigid constraints that follow from the others in a state: the forces of as many are
/// not determined by equilibrium. 0 above `kMaxCountedConstraints`.
[[nodiscard]] Index redundant_constraints(const GeometricallyExactSystem& system,
                                          const State& state);

}  // namespace trammel::solver::large_motion
