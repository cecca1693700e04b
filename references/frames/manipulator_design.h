#pragma once

#include <array>

#include "references/frames/frame_section.h"
#include "references/frames/manipulator_geometry.h"

/// What a planar 3-RRR is made of, in the format of the case files' "manipulator": base_side_m or
/// base_m, links (proximal_length_m and distal_length_m, one or three each; thickness_m, width_m,
/// mass_kg, inertia_kg_m2, beam, shear_coefficient, axial; proximal and distal with what is
/// different), platform (side_m or vertices_m, thickness_m, mass_kg, inertia_kg_m2), material,
/// platform_material, joints (one of each kind for all limbs), working_mode.
namespace trammel::references {

struct LinkNumbers {
  Real length = 0;
  Real mass = 0;
  bool has_inertia = false;  ///< whether it is given, not that of a thin rod
  Real inertia = 0;          ///< about the middle [kg m^2]
  FrameSection section;
};

struct LimbNumbers {
  Point2<Real> base;    ///< A
  Point2<Real> corner;  ///< C from P, in platform axes
  int mode = -1;        ///< side of the elbow, as in `elbow`
  LinkNumbers proximal, distal;
};

struct ManipulatorNumbers {
  std::array<LimbNumbers, 3> limbs;
  Real platform_mass = 0;
  Real platform_inertia = 0;     ///< about its centre of mass
  Point2<Real> platform_center;  ///< of mass, from P, in platform axes
};

/// @throws DerivationError  with the JSON pointer.
[[nodiscard]] ManipulatorNumbers read_manipulator_numbers(const Arguments& manipulator);

/// arguments["manipulator"], all of whose keys are known.
[[nodiscard]] Arguments manipulator_arguments(const Arguments& arguments);

}  // namespace trammel::references
