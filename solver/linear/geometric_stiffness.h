#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/linear/element_operators.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

/// Geometric stiffness: how the forces of a state act on small further motions. The loads keep
/// their direction and the geometry is the undeformed one (second-order theory). Like the elastic
/// stiffness it is a sum of B^T H B over a few motions of each element.
namespace trammel::solver {

/// The work to the second order that a force does on a point which a rotation moves, d^T H d / 2
/// with d = B u: d is the rotation, and for a slider also its way along the turning rail.
struct TurningPart {
  std::array<Index, 5> coordinates{-1, -1, -1, -1, -1};  ///< unconstrained; -1: not used
  Eigen::Matrix<double, 2, 5> B = Eigen::Matrix<double, 2, 5>::Identity();
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
};

/// The forces of a state.
struct Prestress {
  Eigen::VectorXd axial;  ///< frame element: mean axial force, tension positive [N]
  Eigen::VectorXd
      axial_variation;  ///< frame element: axial force at its second end less the first's [N]
  /// (sxx, syy, sxy) of the triangles in turn, at the centroid or, of a six-node one, at its
  /// integration points [Pa]
  Eigen::MatrixX3d stress;
  std::vector<TurningPart> turning;  ///< forces whose points the turning of a node shifts
};

/// What acts on masses: the model's gravity, and more (the centrifugal forces of a rotating frame).
struct BodyForces {
  std::vector<Vector2d> element;     ///< per length of each frame element, loads included [N/m]
  std::vector<Vector2d> point_mass;  ///< on the centre of each point mass [N]
};

/// Of the model's own loads and gravity.
[[nodiscard]] BodyForces body_forces(const System& system);

/// @param u  displacements of the unconstrained coordinates
/// @param multipliers  of the constraints in that state: the forces of inextensible members and
///                     rigid bodies
[[nodiscard]] Prestress prestress(const System& system, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& multipliers, const BodyForces& body);

/// What rounding changes in the forces of a state q, of one sign everywhere: those of members, on
/// the arms of rigid bodies and of plates, whose stress it makes one of equal tension all round.
/// @param q  free coordinates
[[nodiscard]] Prestress prestress_roundoff(const System& system, const Eigen::VectorXd& q);

/// singular where redundant constraints, whose forces nothing determines, stiffen or soften a free
/// motion: an inextensible member between two clamps can be pulled taut by any force.
[[nodiscard]] Outcome require_determined_stiffening(const System& system);

/// Axial force of each element [N], of inextensible ones from their constraint.
[[nodiscard]] Eigen::VectorXd axial_forces(const System& system, const Eigen::VectorXd& u,
                                           const Eigen::VectorXd& multipliers);

/// Rows, in world dofs: rotation psi = (v2 - v1) / L of the chord, symmetric and antisymmetric
/// bending s, a of frame_element.h. Over the interpolation of all beam theories
///   integral N v'^2 dx = L d^T H d,  H = [N, n/12, 0; n/12, N/12, g n/60; 0, g n/60, g^2 N/20]
/// with g = 1 / (1 + Phi), N the mean force and n its growth along the element, linear.
[[nodiscard]] FrameDeformation frame_chord_rotation_and_bending(const Vector2d& direction,
                                                                double length);

[[nodiscard]] SparseMatrix geometric_stiffness(const System& system, const Prestress& state);

/// The geometric stiffness times u, on the unconstrained coordinates.
[[nodiscard]] Eigen::VectorXd geometric_stiffness_forces(const System& system,
                                                         const Prestress& state,
                                                         const Eigen::VectorXd& u);

/// The same for one element, in its own axes; u in world axes.
[[nodiscard]] Vector6d geometric_stiffness_forces(const FrameElement& element, BeamTheory theory,
                                                  double axial, double axial_variation,
                                                  const Vector6d& u);

/// What rounding makes of x^T K_G x, that of the forces (`prestress_roundoff`) included.
/// @param x  free coordinates
[[nodiscard]] double geometric_energy_roundoff(const System& system, const SparseMatrix& K_G,
                                               const Prestress& roundoff, const Eigen::VectorXd& x);

}  // namespace trammel::solver
