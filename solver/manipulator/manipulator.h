#pragma once

#include <array>
#include <optional>
#include <type_traits>

#include "solver/manipulator/kinematics.h"
#include "solver/model/effects.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

/// The 3-RRR builder: a geometry, a pose and the choices the paper leaves open make a Model.
namespace trammel::solver {

/// A choice for one joint; the stiffness belongs to the kind `sprung` alone.
template <class Kind>
struct Joint {
  Kind kind{};
  double stiffness = 0;  ///< > 0 [N m/rad]
};

/// At A_i. locked: clamped to the ground; sprung: a torsion spring between ground and link.
enum class ActiveKind { locked, free, sprung };
/// At B_i. The node's rotation is the proximal link's; a hinge or spring sits on the distal end.
enum class ElbowKind { welded, hinged, sprung };
/// At C_i. hinged: Eq. 24 alone. eq25_*: hinged, and the platform's rotation zeta is tied to the
/// three link ends' rotations by Eq. 25, zeta = mean, or zeta = sum as printed. All but `hinged`
/// need a rigid platform: a node of triangles has no rotation. Eq. 25 is one equation for all
/// three.
enum class PlatformJointKind { hinged, welded, sprung, eq25_mean, eq25_sum };

using ActiveJoint = Joint<ActiveKind>;
using ElbowJoint = Joint<ElbowKind>;
using PlatformJoint = Joint<PlatformJointKind>;

/// A straight link of rectangular section. Over Dual (numbers.h) it carries a derivative.
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
  std::optional<double> mass;  ///< printed total, spread over the length [kg]; empty: from density
  /// Printed inertia J [kg m^2]: J/2 turns with each end of the link, whatever the mesh, on top of
  /// the inertia that the mass has by its spread. Empty: that of the mass alone.
  std::optional<double> inertia;
};
using LinkDesign = LinkDesignOf<double>;

enum class PlatformKind { rigid, triangles };

template <class T>
struct PlatformDesignOf {
  using Kind = PlatformKind;
  Kind kind = Kind::triangles;
  T thickness = T(0);  ///< [m]
  MaterialOf<T> material;
  /// Triangles only. 0: the paper's C1 C2 P, C2 C3 P, C3 C1 P; each step splits every triangle in
  /// four.
  int refinements = 0;
  bool six_nodes = false;  ///< triangles only: quadratic ones
  /// Triangles only. > 0: P and C_i are no nodes of the mesh but move with a weighted mean of the
  /// plate within this radius [m] (`pin_weights`), so that a force on them has a limit under
  /// refinement. At most 500 nodes within a pin at C_i: a link couples each with each.
  double pin_radius = 0;
  /// Printed [kg]; empty: from density, thickness and area. It scales the density.
  std::optional<double> mass;
  /// Printed, about P [kg m^2]; rigid only. Empty: that of a uniform triangle of the mass. The
  /// centre of mass is the triangle's centroid either way, wherever P is.
  std::optional<double> inertia;
};
using PlatformDesign = PlatformDesignOf<double>;

struct ManipulatorDesign {
  ManipulatorGeometry geometry;
  std::array<LinkDesign, 3> proximal, distal;
  PlatformDesign platform;
  std::array<ActiveJoint, 3> active;
  std::array<ElbowJoint, 3> elbow;
  std::array<PlatformJoint, 3> platform_joint;
};

/// The uniform triangle C1 C2 C3, or what is printed instead.
template <class T>
struct PlatformMassOf {
  T mass = T(0);                       ///< [kg]
  T inertia = T(0);                    ///< about the centre of mass [kg m^2]
  Vector2d center = Vector2d::Zero();  ///< of mass, from P in platform axes [m]
};
using PlatformMass = PlatformMassOf<double>;

/// @throws ModelError  where the triangle has no area or the printed inertia is less than its mass
///                     has about P by being off P.
template <Real T>
[[nodiscard]] PlatformMassOf<T> platform_mass(const PlatformDesignOf<T>& platform,
                                              const std::array<Vector2d, 3>& vertices);
[[nodiscard]] PlatformMass platform_mass(const ManipulatorDesign& design);
/// @throws ModelError  where a dimension or a constant has no meaning.
template <Real T>
[[nodiscard]] SectionOf<T> link_section(const LinkDesignOf<T>& link,
                                        const std::type_identity_t<T>& length);

/// Builds the planar model of a pose: nodes "A1".."A3", "B1".., "C1".., "P" (then the plate's);
/// members "A1-B1".., "B1-C1"..; supports "A1".."A3"; rigid body or plate "platform"; constraints
/// "eq25" or "pin P x"... It carries no loads and no gravity.
/// @throws ModelError  where the pose is out of reach or a combination has no meaning.
[[nodiscard]] Model build_manipulator(const ManipulatorDesign& design, const Pose& pose);

/// The manipulator without the effects that are not in `active`, before a model is built of it.
[[nodiscard]] ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active);

}  // namespace trammel::solver
