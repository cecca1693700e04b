#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "solver/manipulator/kinematics.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// Builds the Model of a planar 3-RRR manipulator from its geometry, its pose and modeling options.
/// Varalakshmi & Srinivas (2017) do not specify these options.
namespace trammel::solver {

/// Type of a joint of the manipulator and stiffness of its torsion spring. Only the type `sprung`
/// uses the stiffness.
template <class Kind>
struct Joint {
  Kind kind{};
  double stiffness = 0;  ///< stiffness of the torsion spring, > 0 [N m/rad]
};

/// Type of the actuated joint at A_i, between ground and proximal link. locked: the link is clamped
/// to the ground; free: the link rotates freely; sprung: a torsion spring connects link and ground.
enum class ActiveKind { locked, free, sprung };
/// Type of the elbow joint at B_i, between proximal and distal link. The node B_i rotates with the
/// proximal link. A hinge or a torsion spring connects the end of the distal link to this node.
enum class ElbowKind { welded, hinged, sprung };
/// Type of the joint at C_i, between distal link and platform. hinged: only the displacements of
/// link and platform are equal (Varalakshmi & Srinivas 2017, Eq. 24). eq25_*: hinged, and Eq. 25 of
/// this paper sets the platform rotation zeta. zeta is the mean (eq25_mean) or, as printed, the sum
/// (eq25_sum) of the rotations of the three link ends. With Eq. 25, all three joints must have the
/// same type. All types except `hinged` require a rigid platform, because a node of an elastic
/// platform has no rotation.
enum class PlatformJointKind { hinged, welded, sprung, eq25_mean, eq25_sum };

using ActiveJoint = Joint<ActiveKind>;
using ElbowJoint = Joint<ElbowKind>;
using PlatformJoint = Joint<PlatformJointKind>;

/// Straight link of rectangular section. With T = Dual (numbers.h), each property includes its
/// derivative with respect to one parameter.
template <class T>
struct LinkDesignOf {
  T thickness = T(0);  ///< depth of the section, in the plane of motion [m]
  T width = T(0);      ///< width of the section, perpendicular to the plane of motion [m]
  MaterialOf<T> material;
  double shear_coefficient = 5.0 / 6.0;  ///< kappa, for theories with shear deformation
  BeamTheory theory = BeamTheory::euler_bernoulli;
  MassMatrix mass_matrix = MassMatrix::consistent;
  Index elements = 4;
  bool axially_flexible = true;
  /// Total mass of the link as printed in a paper ("printed mass"), distributed over the length
  /// [kg]. If empty, the mass follows from the density.
  std::optional<double> mass;
  /// Inertia J of the link as printed in a paper [kg m^2]. A rotary inertia J/2 is added at each
  /// end of the link, for any number of elements. The distributed mass has its inertia in addition.
  /// If J is empty, only the distributed mass has inertia.
  std::optional<double> inertia;
};
using LinkDesign = LinkDesignOf<double>;

/// Model of the platform: a rigid body, or an elastic plate meshed by triangles.
enum class PlatformKind { rigid, triangles };

/// Model, dimensions and material of the platform.
template <class T>
struct PlatformDesignOf {
  using Kind = PlatformKind;
  Kind kind = Kind::triangles;
  T thickness = T(0);  ///< thickness of the platform [m]
  MaterialOf<T> material;
  /// Number of refinements of a platform of triangles. The mesh without refinement has the
  /// triangles C1 C2 P, C2 C3 P and C3 C1 P. Each refinement splits every triangle into four.
  int refinements = 0;
  /// true: a platform meshed by triangles has six nodes per triangle; false: three.
  bool six_nodes = false;
  /// Radius of the pins at P and C_i in a platform that is meshed by triangles [m]. If the radius
  /// is positive, P and C_i are not nodes of the mesh. The displacement of a pin is then a weighted
  /// mean of the displacements of the mesh nodes within this radius (`pin_weights`). The response
  /// to a force on a pin therefore converges under mesh refinement. A pin at C_i may contain at
  /// most 500 mesh nodes, because the distal link couples all nodes of the pin.
  double pin_radius = 0;
  /// Mass of the platform as printed in a paper [kg]. If empty, the mass follows from the density.
  std::optional<double> mass;
  /// Inertia of a rigid platform about P as printed in a paper [kg m^2]. If empty, the inertia is
  /// that of the uniform triangle C1 C2 C3 with the mass of the platform. In both cases the center
  /// of mass is the centroid of this triangle, for any position of P.
  std::optional<double> inertia;
};
using PlatformDesign = PlatformDesignOf<double>;

/// Design of the manipulator: dimensions, links, platform and joints.
struct ManipulatorDesign {
  ManipulatorGeometry geometry;
  std::array<LinkDesign, 3> proximal, distal;
  PlatformDesign platform;
  std::array<ActiveJoint, 3> active;
  std::array<ElbowJoint, 3> elbow;
  std::array<PlatformJoint, 3> platform_joint;
};

/// Mass properties of the platform, from the uniform triangle C1 C2 C3 or from printed values.
template <class T>
struct PlatformMassOf {
  T mass = T(0);                       ///< mass of the platform [kg]
  T inertia = T(0);                    ///< moment of inertia about the center of mass [kg m^2]
  Vector2d center = Vector2d::Zero();  ///< center of mass relative to P in platform axes [m]
};
using PlatformMass = PlatformMassOf<double>;

/// Returns the mass properties of the platform.
/// @param platform  design of the platform.
/// @param vertices  positions of C1, C2, C3 relative to P in platform axes [m].
/// @throws ModelError  if the triangle C1 C2 C3 has no area and the design contains no mass. Also
///   if the given inertia is less than the mass times the squared distance of the center of mass
///   from P.
template <Real T>
[[nodiscard]] PlatformMassOf<T> platform_mass(const PlatformDesignOf<T>& platform,
                                              const std::array<Vector2d, 3>& vertices);
/// Returns the mass properties of the platform of a manipulator design.
[[nodiscard]] PlatformMass platform_mass(const ManipulatorDesign& design);
/// Returns the properties of the cross-section of a link of the given length [m].
/// @throws ModelError  if a dimension or a material constant of the link is invalid.
template <Real T>
[[nodiscard]] SectionOf<T> link_section(const LinkDesignOf<T>& link,
                                        const std::type_identity_t<T>& length);

/// Builds the planar model of the manipulator at a pose, without loads and without gravity. The
/// model contains:
///
/// - nodes "A1".."A3", "B1".., "C1".., "P", then the other nodes of the plate;
/// - members "A1-B1".., "B1-C1"..;
/// - supports "A1".."A3";
/// - rigid body or plate "platform";
/// - constraint "eq25" (Eq. 25), or constraints "pin P x".. of the pins in the platform.
///
/// @throws ModelError  if the pose is out of reach or a combination of options is invalid.
[[nodiscard]] Model build_manipulator(const ManipulatorDesign& design, const Pose& pose);

/// Returns the design without the physical effects that are missing in `active`. For example,
/// springs become rigid joints, and an elastic platform becomes a rigid body.
[[nodiscard]] ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active);

}  // namespace trammel::solver
