#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Geometric stiffness K_G: stiffness against small further motions that results from the internal
/// forces of a loaded state. Loads keep their direction, and the geometry is undeformed
/// (second-order theory). The matrix is a sum of B^T H B over a few motions of each element, like
/// the elastic stiffness.
namespace trammel::solver {

/// Geometric stiffness of a force on a point that moves with the rotation of a node. The
/// second-order work of the force is d^T H d / 2 with d = B u. d consists of the rotation and, for
/// a slider, its displacement along the turning rail.
struct TurningPart {
  std::array<Index, 5> coordinates{-1, -1, -1, -1, -1};  ///< indices into u; -1: unused
  Eigen::Matrix<double, 2, 5> B = Eigen::Matrix<double, 2, 5>::Identity();
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
};

/// Internal forces of a loaded state, from which the geometric stiffness follows.
struct Prestress {
  Eigen::VectorXd axial;  ///< mean axial force of each frame element, tension positive [N]
  /// Axial force at the second end minus axial force at the first end of each frame element [N].
  Eigen::VectorXd axial_variation;
  /// Stresses (sxx, syy, sxy) of the triangles in sequence [Pa]. Three-node triangles have one row
  /// at the centroid. Six-node triangles have one row for each integration point.
  Eigen::MatrixX3d stress;
  std::vector<TurningPart> turning;  ///< forces on points that move with the rotation of a node
};

/// Forces on masses: gravity of the model and additional forces, such as the centrifugal forces of
/// a rotating frame.
struct BodyForces {
  /// Force per length of each frame element, including member loads [N/m].
  std::vector<Vector2d> element;
  std::vector<Vector2d> point_mass;  ///< force on the center of mass of each point mass [N]
};

/// Returns the member loads and the weight of members and point masses of the model.
[[nodiscard]] BodyForces body_forces(const System& system);

/// Computes the internal forces of a state from its displacements.
/// @param system  assembled model.
/// @param u  displacements of the unconstrained coordinates [m, rad].
/// @param multipliers  multipliers of the constraints in the state: forces of inextensible members
///   and rigid bodies.
/// @param body  forces on masses and members.
[[nodiscard]] Prestress prestress(const System& system, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& multipliers, const BodyForces& body);

/// Returns the round-off errors of the internal forces of a state with the free coordinates q, all
/// with the same sign. They include forces of members, forces on arms of rigid bodies, and stresses
/// of plates. The stress error is represented as equal tension in all directions.
[[nodiscard]] Prestress prestress_roundoff(const System& system, const Eigen::VectorXd& q);

/// Returns the outcome `singular` if forces of redundant constraints stiffen or soften the model.
/// Statics does not determine these forces. For example, any force can act in an inextensible
/// member between two clamps.
[[nodiscard]] Outcome require_determinate_prestress(const System& system);

/// Returns the axial force of each frame element [N]. The force of an inextensible element follows
/// from its constraint.
[[nodiscard]] Eigen::VectorXd axial_forces(const System& system, const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& multipliers);

/// Returns the 3 x 6 matrix from the end displacements of a frame element in world axes to d =
/// (psi, s, a). The rotation of the chord is psi = (v2 - v1) / L. Symmetric and antisymmetric
/// bending s, a are defined in frame_element.h. For all beam theories the work of the axial force N
/// on the slope v' is
///
///   \f[ \int N v'^2 dx = L\, d^T H d. \f]
///
///   H = [N, n/12, 0; n/12, N/12, g n/60; 0, g n/60, g^2 N/20],  g = 1 / (1 + Phi).
///
/// In H, N is the mean axial force, n is its increase from the first to the second end, and Phi is
/// `shear_ratio`.
[[nodiscard]] FrameDeformation frame_chord_rotation_and_bending(const Vector2d& direction,
                                                                double length);

/// Returns the geometric stiffness K_G of the free coordinates, q x q.
[[nodiscard]] SparseMatrix geometric_stiffness(const System& system, const Prestress& state);

/// Returns the geometric stiffness times u on the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd geometric_stiffness_forces(const System& system,
                                                         const Prestress& state,
                                                         const Eigen::VectorXd& u);

/// Returns the geometric stiffness forces of one element in its axes [N, N m]; u is in world axes.
[[nodiscard]] Vector6d geometric_stiffness_forces(const FrameElement& element, BeamTheory theory,
                                                  double axial, double axial_variation,
                                                  const Vector6d& u);

/// Returns the round-off error of x^T K_G x [J] for free coordinates x, including that of the
/// internal forces (`prestress_roundoff`).
/// @param system  assembled model.
/// @param K_G  geometric stiffness, q x q.
/// @param roundoff  round-off errors of the forces.
/// @param x  free coordinates.
[[nodiscard]] double geometric_energy_roundoff(const System& system, const SparseMatrix& K_G,
                                               const Prestress& roundoff, const Eigen::VectorXd& x);

}  // namespace trammel::solver
