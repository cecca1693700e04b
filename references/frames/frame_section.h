#pragma once

#include "references/frames/frame.h"
#include "references/numerics/arguments.h"

/// From materials and cross-sections to what a member is made of.
namespace trammel::references {

struct FrameMaterial {
  Real E = 0;    ///< [Pa]
  Real rho = 0;  ///< [kg/m^3]
  Real nu = 0;   ///< [-]
};

struct CrossSection {
  FrameMaterial material;
  Real area = 0;                         ///< [m^2]
  Real second_moment = 0;                ///< about the axis of bending [m^4]
  Real half_depth = 0;                   ///< 0: not known [m]
  Real shear_coefficient = Real(5) / 6;  ///< [-]
};

/// @param thickness  in the plane of the frame [m];  @param width  across it [m].
[[nodiscard]] CrossSection rectangle(const FrameMaterial& material, const Real& thickness,
                                     const Real& width);

/// The section of a member by its theory: "beam" (euler-bernoulli, by default, shear with
/// 1/(kappa G A), rayleigh with rho I, timoshenko with both) and "axial" (flexible, by default, or
/// inextensible).
/// @throws DerivationError  with the JSON pointer, where the member names another theory.
[[nodiscard]] FrameSection member_section(const CrossSection& section, const Arguments& member);

}  // namespace trammel::references
