#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Geometric stiffness K_G: stiffness against small additional displacements that results from the
/// internal forces of a loaded state. Loads keep their directions, and the geometry is undeformed
/// (second-order theory). The matrix is a sum of B^T H B over a few deformations of each element,
/// like the elastic stiffness matrix.
namespace trammel::solver {

/// Geometric stiffness of a force on a point that moves with the rotation of a node. The
/// second-order work of the force is d^T H d / 2 with d = B u. The components of d are the rotation
/// and, for a slider, the displacement of the slider along the rotating rail.
struct TurningPart {
  std::array<Index, 5> coordinates{-1, -1, -1, -1, -1};  ///< indices into u; -1: unused
  Eigen::Matrix<double, 2, 5> B = Eigen::Matrix<double, 2, 5>::Identity();
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
};

/// Internal forces of a loaded state, from which the geometric stiffness follows.
struct Prestress {
  Eigen::VectorXd axial;  ///< mean axial force of each frame element, tension positive [N]
  /// Increase of the axial force from the first to the second end of each frame element [N].
  Eigen::VectorXd axial_variation;
  /// Stresses (sxx, syy, sxy) of the triangles in the order of the model [Pa]. Three-node triangles
  /// have one row, at the centroid. Six-node triangles have one row for each integration point.
  Eigen::MatrixX3d stress;
  std::vector<TurningPart> turning;  ///< forces on points that move with the rotation of a node
};

/// Forces per length and on masses: member loads, weight and additional forces, such as the
/// centrifugal forces of a rotating frame.
struct BodyForces {
  /// Force per length of each frame element, including member loads [N/m].
  std::vector<Vector2d> element;
  std::vector<Vector2d> point_mass;  ///< force on the center of mass of each point mass [N]
};

/// Returns the member loads and the weight of the members and point masses of the model.
[[nodiscard]] BodyForces body_forces(const System& system);

/// Computes the internal forces of a state from its displacements.
/// @param system  assembled model.
/// @param u  displacements of the unconstrained coordinates [m, rad].
/// @param multipliers  Lagrange multipliers of the constraints: forces of inextensible members and
///   rigid bodies.
/// @param body  forces on members and point masses.
[[nodiscard]] Prestress prestress(const System& system, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& multipliers, const BodyForces& body);

/// Returns the magnitudes of the round-off errors of the internal forces of a state with the free
/// coordinates q. The internal forces are forces of members, forces on points of rigid bodies and
/// rails (`TurningPart`), and stresses of plates. The error of a stress is returned as equal
/// tension in all directions.
[[nodiscard]] Prestress prestress_roundoff(const System& system, const Eigen::VectorXd& q);

/// Returns the outcome `singular` if forces of redundant constraints stiffen or soften the model.
/// Statics does not determine such forces. For example, any force can act in an inextensible member
/// between two clamps.
[[nodiscard]] Outcome require_determinate_prestress(const System& system);

/// Returns the axial force of each frame element [N]. The force of an inextensible element follows
/// from its constraint.
[[nodiscard]] Eigen::VectorXd axial_forces(const System& system, const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& multipliers);

/// Returns the 3 x 6 matrix that maps the end displacements of a frame element in world axes to d =
/// (psi, s, a). The rotation of the chord is psi = (v2 - v1) / L. Symmetric bending s and
/// antisymmetric bending a are defined in frame_element.h. For all beam theories, the work of the
/// axial force N on the slope v' is
///
///   \f[ \int N v'^2 dx = L\, d^T H d. \f]
///
///   H = [N, n/12, 0; n/12, N/12, g n/60; 0, g n/60, g^2 N/20],  g = 1 / (1 + Phi).
///
/// In H, N is the mean axial force, n is the increase of the axial force from the first to the
/// second end, and Phi is `shear_ratio`.
[[nodiscard]] FrameDeformation frame_chord_rotation_and_bending(const Vector2d& direction,
                                                                double length);

/// Returns the geometric stiffness matrix K_G of the free coordinates, q x q.
[[nodiscard]] SparseMatrix geometric_stiffness(const System& system, const Prestress& state);

/// Returns the geometric stiffness matrix times u on the unconstrained coordinates [N, N m].
[[nodiscard]] Eigen::VectorXd geometric_stiffness_forces(const System& system,
                                                         const Prestress& state,
                                                         const Eigen::VectorXd& u);

/// Returns the geometric stiffness forces of a frame element in element axes [N, N m]; u is in
/// world axes.
[[nodiscard]] Vector6d geometric_stiffness_forces(const FrameElement& element, BeamTheory theory,
                                                  double axial, double axial_variation,
                                                  const Vector6d& u);

/// Returns the round-off error of x^T K_G x [J] for free coordinates x, including the effect of the
/// errors of the internal forces (`prestress_roundoff`).
/// @param system  assembled model.
/// @param K_G  geometric stiffness matrix, q x q.
/// @param roundoff  round-off errors of the internal forces.
/// @param x  free coordinates.
[[nodiscard]] double geometric_energy_roundoff(const System& system, const SparseMatrix& K_G,
                                               const Prestress& roundoff, const Eigen::VectorXd& x);

}  // namespace trammel::solver
