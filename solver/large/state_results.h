#pragma once

#include <Eigen/Core>

#include "solver/large/geometrically_exact_system.h"
#include "solver/linear/statics.h"

/// Results of a state for the parts of the model, in the order and with the signs of
/// `StaticSolution`.
namespace trammel::solver::large_motion {

/// Returns model node x (x, y, rotation) of coordinates, velocities or accelerations. The rotation
/// is NaN for a node without rotation.
[[nodiscard]] Eigen::MatrixX3d node_motion(const GeometricallyExactSystem& system,
                                           const VectorXd& values);

/// Returns support x (Fx, Fy [N], moment [N m]), the forces of the ground on the node including
/// inertia. Supports that hold a shared coordinate each show its full reaction.
[[nodiscard]] Eigen::MatrixX3d reactions(const GeometricallyExactSystem& system,
                                         const State& state);

/// Returns a state in the form of `solve_statics`: displacements, end rotations, reactions, and
/// section forces along the axes of the rotated sections.
[[nodiscard]] StaticSolution static_solution(const GeometricallyExactSystem& system,
                                             const State& state);

/// Residual of the equilibrium of members that are cut free. It includes the section forces at
/// their ends, loads, weight and inertia in the deformed position.
class MemberBalance {
 public:
  /// Adds the members of a state.
  /// @param system  equations.
  /// @param state  satisfies the equation of motion.
  void add(const GeometricallyExactSystem& system, const State& state);
  /// Returns the largest sum of forces, or of moments about a first end, over the largest terms of
  /// such sums. States and members whose forces are only round-off errors do not contribute.
  [[nodiscard]] double residual() const;

 private:
  double force_ = 0, moment_ = 0;              // largest sums [N, N m]
  double force_terms_ = 0, moment_terms_ = 0;  // largest sums of magnitudes [N, N m]
  double length_ = 0;                          // longest member [m]
};

/// Returns the force [N] or torque [N m] of a drive on the structure.
[[nodiscard]] double drive_force(const GeometricallyExactSystem& system, const State& state,
                                 Index drive);

/// Returns world positions of the element nodes of a member, first to second node: point x (x, y)
/// [m].
[[nodiscard]] Eigen::MatrixX2d member_node_positions(const GeometricallyExactSystem& system,
                                                     const VectorXd& q, Index member);

/// Largest number of rigid constraints, most of which belong to members, whose rank is computed.
/// Above it, the factorization for the rank takes longer than statics.
inline constexpr Index kMaxCountedConstraints = 400;

/// Returns the number of redundant rigid constraints in a state. Equilibrium does not determine the
/// forces of as many constraints. The result is 0 above `kMaxCountedConstraints`.
[[nodiscard]] Index redundant_constraints(const GeometricallyExactSystem& system,
                                          const State& state);

}  // namespace trammel::solver::large_motion
