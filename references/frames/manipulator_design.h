#pragma once

#include <array>

#include "references/frames/frame.h"

/// Data of a planar 3-RRR manipulator in the format of "manipulator" in case files:
/// base_side_m or base_m.
/// links: proximal_length_m and distal_length_m (one or three each), thickness_m, width_m, mass_kg,
/// inertia_kg_m2, beam, shear_coefficient, axial. The objects proximal and distal override these
/// values for one kind of link.
/// platform: side_m or vertices_m, thickness_m, mass_kg, inertia_kg_m2.
/// material, platform_material, joints (active, elbow and platform, equal in all limbs),
/// working_mode.
namespace trammel::references {

template <class Number>
using Point2 = std::array<Number, 2>;

/// Returns a vector rotated by an angle.
template <class Number>
[[nodiscard]] Point2<Number> rotated(const Point2<Real>& v, const Number& angle) {
  const Number c = cos(angle), s = sin(angle);
  return {c * v[0] - s * v[1], s * v[0] + c * v[1]};
}

/// Returns the elbow of a limb: an intersection of the circles of the links about A and C. For the
/// working mode -1, the elbow is on the clockwise side of the line from A to C.
/// @throws DerivationError  if the circles do not intersect.
template <class Number>
[[nodiscard]] Point2<Number> elbow(const Point2<Number>& A, const Point2<Number>& C,
                                   const Real& proximal, const Real& distal, int mode) {
  const Number dx = C[0] - A[0];
  const Number dy = C[1] - A[1];
  const Number r2 = dx * dx + dy * dy;
  const Real squares = proximal * proximal - distal * distal;
  const Number along = (squares + r2) / (Real(2) * r2);  // projection of A B on A C, over |A C|
  const Number height2 = Real(proximal * proximal) / r2 - along * along;
  if (height2 < Real(0)) throw DerivationError("a limb cannot reach its platform joint");
  const Number across = Real(mode) * sqrt(height2);
  return {A[0] + along * dx - across * dy, A[1] + along * dy + across * dx};
}

struct LinkNumbers {
  Real length = 0;
  Real mass = 0;
  bool has_inertia = false;  ///< false: the inertia is that of a thin rod
  Real center = 0;           ///< distance of the center of mass from the first joint
  Real inertia = 0;          ///< about the center of mass [kg m^2]
  FrameSection section;
};

struct LimbNumbers {
  Point2<Real> base;    ///< position of A
  Point2<Real> corner;  ///< C from P, in platform axes
  int mode = -1;        ///< side of the elbow, as in `elbow`
  LinkNumbers proximal, distal;
};

struct ManipulatorNumbers {
  std::array<LimbNumbers, 3> limbs;
  Real platform_mass = 0;
  Real platform_inertia = 0;     ///< moment of inertia about the center of mass
  Point2<Real> platform_center;  ///< center of mass, from P, in platform axes
  Point2<Real> gravity = {0, 0};
};

[[nodiscard]] ManipulatorNumbers read_manipulator_numbers(const Arguments& manipulator);

/// Returns arguments["manipulator"].
/// @throws DerivationError  if it has an unknown key.
[[nodiscard]] Arguments manipulator_arguments(const Arguments& arguments);

/// Returns a planar 3-RRR with a rigid platform as a frame. Closed-form inverse kinematics is used:
/// each B_i is an intersection of the circles of radius |A_i B_i| about A_i and |B_i C_i| about
/// C_i, on the side of the working mode. Nodes A1-A3, B1-B3, C1-C3, P; members A1-B1, B1-C1, ...
///
/// Lengths, sections and masses are those of `read_manipulator_numbers`. The kind of the platform
/// must be "rigid". Active joints are locked, free or springs. Elbow and platform joints are
/// welded, hinged or springs. Platform joints can also be eq25-mean or eq25-sum, which are hinges
/// with a constraint on the rotation of the platform.
/// @throws DerivationError  with the JSON pointer if an argument is invalid, or if a limb cannot
/// reach its platform joint.
[[nodiscard]] Frame manipulator_frame(const Arguments& manipulator, const Arguments& pose);

}  // namespace trammel::references
