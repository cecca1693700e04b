#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "solver/manipulator/kinematics.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// Builder of the 3-RRR manipulator. A geometry, a pose and the options that the paper does not
/// specify define a Model.
namespace trammel::solver {

/// Type of one joint and its stiffness, which is used by the type `sprung` only.
template <class Kind>
struct Joint {
  Kind kind{};
  double stiffness = 0;  ///< > 0 [N m/rad]
};

/// Joint at A_i. locked: clamped to the ground; sprung: torsion spring between ground and link.
enum class ActiveKind { locked, free, sprung };
/// Joint at B_i. The rotation of the node is that of the proximal link. A hinge or spring is at the
/// end of the distal link.
enum class ElbowKind { welded, hinged, sprung };
/// Joint at C_i. hinged: Eq. 24 only. eq25_*: hinged, and Eq. 25 relates the platform rotation zeta
/// to the rotations of the three link ends: zeta = mean, or zeta = sum as printed. All types except
/// `hinged` require a rigid platform, because a node of triangles has no rotation. Eq. 25 is one
/// equation for all three joints.
enum class PlatformJointKind { hinged, welded, sprung, eq25_mean, eq25_sum };

using ActiveJoint = Joint<ActiveKind>;
using ElbowJoint = Joint<ElbowKind>;
using PlatformJoint = Joint<PlatformJointKind>;

/// Straight link of rectangular section. With T = Dual (numbers.h), each property also carries its
/// derivative with respect to one parameter.
template <class T>
struct LinkDesignOf {
  T thickness = T(0);  ///< in the plane [m]
  T width = T(0);      ///< out of the plane [m]
  MaterialOf<T> material;
  double shear_coefficient = 5.0 / 6.0;  ///< Timoshenko only
  BeamTheory theory = BeamTheory::euler_bernoulli;
  MassMatrix mass_matrix = MassMatrix::consistent;
  Index elements = 4;
  bool axially_flexible = true;
  /// Printed total, distributed over the length [kg]; empty: from density.
  std::optional<double> mass;
  /// Printed inertia J [kg m^2]. J/2 turns with each end of the link for any mesh, in addition to
  /// the inertia of the distributed mass. Empty: inertia of the distributed mass only.
  std::optional<double> inertia;
};
using LinkDesign = LinkDesignOf<double>;

/// Model of the platform: a rigid body, or a plate of triangles.
enum class PlatformKind { rigid, triangles };

/// Platform: a rigid body or a plate of triangles.
template <class T>
struct PlatformDesignOf {
  using Kind = PlatformKind;
  Kind kind = Kind::triangles;
  T thickness = T(0);  ///< [m]
  MaterialOf<T> material;
  /// Triangles only. 0: the triangles C1 C2 P, C2 C3 P, C3 C1 P of the paper. Each refinement
  /// splits every triangle into four.
  int refinements = 0;
  bool six_nodes = false;  ///< triangles only: six-node triangles
  /// Triangles only: pin radius [m]. If it is positive, P and C_i are no nodes of the mesh. They
  /// move with a weighted mean of the plate within this radius (`pin_weights`). The response to a
  /// force on them therefore converges under refinement. A pin at C_i may contain at most 500
  /// nodes, because a link couples all of them.
  double pin_radius = 0;
  /// Printed mass [kg]; empty: from density, thickness and area. It scales the density.
  std::optional<double> mass;
  /// Printed inertia about P [kg m^2]; rigid only. Empty: inertia of a uniform triangle with the
  /// mass. The center of mass is the centroid of the triangle in both cases, for any P.
  std::optional<double> inertia;
};
using PlatformDesign = PlatformDesignOf<double>;

/// Design of the manipulator.
struct ManipulatorDesign {
  ManipulatorGeometry geometry;
  std::array<LinkDesign, 3> proximal, distal;
  PlatformDesign platform;
  std::array<ActiveJoint, 3> active;
  std::array<ElbowJoint, 3> elbow;
  std::array<PlatformJoint, 3> platform_joint;
};

/// Mass properties of the uniform triangle C1 C2 C3, or the printed values.
template <class T>
struct PlatformMassOf {
  T mass = T(0);                       ///< [kg]
  T inertia = T(0);                    ///< about the center of mass [kg m^2]
  Vector2d center = Vector2d::Zero();  ///< center of mass relative to P in platform axes [m]
};
using PlatformMass = PlatformMassOf<double>;

/// Returns the mass properties of the platform.
/// @param platform  design of the platform.
/// @param vertices  C1, C2, C3 relative to P in platform axes [m].
/// @throws ModelError  if the triangle has no area, or the printed inertia is less than mass times
///   squared distance of the center of mass from P.
template <Real T>
[[nodiscard]] PlatformMassOf<T> platform_mass(const PlatformDesignOf<T>& platform,
                                              const std::array<Vector2d, 3>& vertices);
/// Returns the mass properties of the platform of a design.
[[nodiscard]] PlatformMass platform_mass(const ManipulatorDesign& design);
/// Returns the section of a link.
/// @param link  design of the link.
/// @param length  length of the link [m].
/// @throws ModelError  if a dimension or a constant is invalid.
template <Real T>
[[nodiscard]] SectionOf<T> link_section(const LinkDesignOf<T>& link,
                                        const std::type_identity_t<T>& length);

/// Builds the planar model at a pose. It has no loads and no gravity. Its parts are:
///
/// - nodes "A1".."A3", "B1".., "C1".., "P", then those of the plate;
/// - members "A1-B1".., "B1-C1"..;
/// - supports "A1".."A3";
/// - rigid body or plate "platform";
/// - constraints "eq25" or "pin P x"...
///
/// @throws ModelError  if the pose is out of reach or a combination of options is invalid.
[[nodiscard]] Model build_manipulator(const ManipulatorDesign& design, const Pose& pose);

/// Returns the design without the effects that are not in `active`, before a model is built.
[[nodiscard]] ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active);

}  // namespace trammel::solver
