#pragma once

#include <array>
#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Planar frame for derivations of references, in SI units and world axes. Nodes and members are
/// identified by their indices.
namespace trammel::references {

/// Properties of a cross section. Axial and shear stiffness are stored as compliances, which are 0
/// for rigid sections.
struct FrameSection {
  Real axial_compliance = 0;  ///< 1 / EA [1/N]; 0: inextensible
  Real EI = 0;                ///< [N m^2]
  Real shear_compliance = 0;  ///< 1 / (kappa G A) [1/N]; 0: Euler-Bernoulli
  Real mass = 0;              ///< rho A [kg/m]
  Real rotary_inertia = 0;    ///< rho I [kg m]; 0: Euler-Bernoulli
  Real area = 0;              ///< [m^2]
  Real modulus = 0;           ///< section modulus [m^3]
  Real tension = 0;           ///< axial force of the prestressed state [N]
};

struct FrameMaterial {
  Real E = 0;    ///< [Pa]
  Real rho = 0;  ///< [kg/m^3]
  Real nu = 0;   ///< [-]
};

/// Reads a material from the JSON object where[key], which has the keys "E_Pa", "rho_kg_m3" and
/// "nu".
[[nodiscard]] FrameMaterial read_material(const Arguments& where, const std::string& key);

/// Returns a section with the compliances and inertias for every beam theory.
/// @param half_depth  distance of the outermost fiber from the axis; 0 if it is unknown [m].
[[nodiscard]] FrameSection timoshenko_section(const FrameMaterial& material, const Real& area,
                                              const Real& second_moment, const Real& half_depth,
                                              const Real& shear_coefficient);

/// Returns the section of a rectangle.
/// @param thickness  in the plane of the frame [m];  @param width  normal to this plane [m].
[[nodiscard]] FrameSection rectangular_section(const FrameMaterial& material, const Real& thickness,
                                               const Real& width, const Real& shear_coefficient);

/// Returns a section without the compliances and inertias that the theory of the member omits. The
/// key "beam" is euler-bernoulli (default), shear, rayleigh or timoshenko. Shear and timoshenko
/// keep 1/(kappa G A); rayleigh and timoshenko keep rho I. The key "axial" is flexible (default) or
/// inextensible.
/// @throws DerivationError  with the JSON pointer, if a key has another value.
[[nodiscard]] FrameSection section_for_beam_theory(FrameSection section, const Arguments& member);

enum class Fixity { welded, hinged, sprung };

struct FrameEnd {
  Fixity fixity = Fixity::welded;
  Real stiffness = 0;  ///< rotational spring between end and node [N m/rad]
  Real inertia = 0;    ///< moment of inertia fixed to the member end [kg m^2]
};

struct FrameMember {
  std::string name;
  std::array<int, 2> nodes{};
  FrameSection section;
  std::array<FrameEnd, 2> ends{};
  std::array<Real, 2> load{};  ///< load per unit length, world axes [N/m]
};

struct FrameNode {
  std::string name;
  std::array<Real, 2> position{};  ///< [m]
};

struct FrameBody {
  int reference = 0;
  std::vector<int> attached;
};

struct FrameMass {
  int node = 0;
  Real mass = 0;     ///< [kg]
  Real inertia = 0;  ///< moment of inertia about the center of mass [kg m^2]
  std::array<Real, 2> offset{};
};

struct FrameSpring {
  std::array<int, 2> nodes{-1, -1};  ///< the second is -1 for the ground
  std::array<Real, 3> stiffness{};   ///< x, y [N/m], rotation [N m/rad]
};

struct FrameSupport {
  int node = 0;
  std::array<bool, 3> fixed{};
};

struct FrameLoad {
  int node = 0;
  std::array<Real, 3> force{};  ///< Fx, Fy [N], moment [N m]
};

/// Reads a joint: "welded" or "locked", "hinged" or "free", or {"spring_N_m_per_rad": k}.
/// @throws DerivationError  with the JSON pointer, if the value is none of these.
[[nodiscard]] FrameEnd read_end_fixity(const Json& value, const Arguments& where,
                                       const std::string& key);

/// Constraint of a node: the rotation of the node is `share` times the sum of the rotations of the
/// member ends in `ends`.
struct RotationConstraint {
  int node = 0;
  Real share = 0;
  std::vector<std::array<int, 2>> ends;  ///< index of the member, and 0 (start) or 1 (end)
};

struct Frame {
  std::vector<FrameNode> nodes;
  std::vector<FrameMember> members;
  std::vector<FrameBody> bodies;
  std::vector<FrameMass> masses;
  std::vector<FrameSpring> springs;
  std::vector<FrameSupport> supports;
  std::vector<FrameLoad> loads;
  std::vector<RotationConstraint> constraints;
  std::array<Real, 2> gravity{};  ///< [m/s^2]

  [[nodiscard]] int find_node(const std::string& name) const;    ///< -1 if absent
  [[nodiscard]] int find_member(const std::string& name) const;  ///< -1 if absent
};

struct MemberAxis {
  Real length, cosine, sine;
};
[[nodiscard]] MemberAxis member_axis(const Frame& frame, const FrameMember& member);

/// Returns the frame of the arguments "model" (as in a case file), or "manipulator" with "pose"
/// (x_m, y_m, phi_rad) and "loads".
[[nodiscard]] Frame frame_from_arguments(const Arguments& arguments);

}  // namespace trammel::references
