#pragma once

#include <array>

/// Manufactured solutions: smooth fields in closed form, and the loads that balance them. A field
/// is chosen first; strain, stress and load follow from it by differentiation, so that the exact
/// solution of a problem without special symmetry is known. Motion is harmonic, field * cos(omega
/// t); omega = 0 is statics. Source: P. J. Roache, "Code Verification by the Method of Manufactured
/// Solutions", J. Fluids Eng. 124(1), 2002, doi:10.1115/1.1436090.
namespace trammel::references::manufactured {

/// Manufactured displacement fields of a membrane in plane stress on the rectangle 0 <= x <=
/// length, 0 <= y <= height.
enum class MembraneField {
  clamped,         ///< trigonometric; zero on all four sides, loaded by body forces only
  cantilever,      ///< trigonometric and exponential; zero at x = 0, tractions on other sides
  uniform_strain,  ///< linear displacement: the patch test of three-node triangles
  linear_strain,   ///< quadratic displacement: the patch test of six-node triangles
};

struct MembraneProblem {
  MembraneField field = MembraneField::clamped;
  double E = 0;          ///< [Pa]
  double nu = 0;         ///< [-]
  double rho = 0;        ///< [kg/m^3]
  double length = 0;     ///< along x [m]
  double height = 0;     ///< along y [m]
  double amplitude = 0;  ///< size of the displacement [m]
  double omega = 0;      ///< [rad/s]
};

struct MembraneState {
  std::array<double, 2> displacement;  ///< u, v [m]
  double rotation;                     ///< (dv/dx - du/dy) / 2 [rad]
  std::array<double, 3> strain;        ///< exx, eyy, gxy [-]
  std::array<double, 3> stress;        ///< sxx, syy, sxy [Pa]
  std::array<double, 2> body_force;    ///< -div(stress) - rho omega^2 displacement [N/m^3]
};

[[nodiscard]] MembraneState evaluate(const MembraneProblem& problem, double x, double y);

/// Returns two flags for u and v: true if the problem fixes this displacement at a boundary point.
/// A fixed displacement is zero in the manufactured field.
[[nodiscard]] std::array<bool, 2> fixed_displacements(const MembraneProblem& problem, double x,
                                                      double y);

/// Manufactured displacement fields of a beam along 0 <= x <= length. The beam is clamped at x = 0
/// and loaded by (N, V, M) at the other end.
enum class BeamField {
  smooth,  ///< exponential and trigonometric
  cubic,   ///< requires no transverse load; prismatic elements represent it exactly
};

enum class ShearStrain {
  none,          ///< Euler-Bernoulli: the section stays normal, no rotary inertia
  from_bending,  ///< Timoshenko: shear angle that requires no static distributed moment
  independent,   ///< Timoshenko: an independent shear angle, supported by a distributed moment
};

struct BeamProblem {
  BeamField field = BeamField::smooth;
  ShearStrain shear = ShearStrain::none;
  double EA = 0;                  ///< [N]
  double EI = 0;                  ///< [N m^2]
  double kappa_GA = 0;            ///< [N]; not used for Euler-Bernoulli
  double mass_per_length = 0;     ///< rho A [kg/m]
  double inertia_per_length = 0;  ///< rho I [kg m]; not used for Euler-Bernoulli
  double length = 0;              ///< [m]
  double amplitude = 0;           ///< size of the displacement [m]
  double omega = 0;               ///< [rad/s]
};

/// Displacements, internal forces and loads at a point of a beam, in its axes: x along the beam, y
/// to its left. N = EA u', M = EI θ', and V = kappa GA (v' - θ). For Euler-Bernoulli beams V = -M'.
struct BeamState {
  double axial, deflection, rotation;               ///< u, v [m], θ [rad]
  double axial_force, shear_force, bending_moment;  ///< N, V [N], M [N m]
  /// Loads n, q [N/m] and m [N m/m] that make the field satisfy the equations of motion
  /// N' + n + rho A omega^2 u = 0, V' + q + rho A omega^2 v = 0, M' + V + m + rho I omega^2 θ = 0.
  double axial_load, transverse_load, moment_load;
};

[[nodiscard]] BeamState evaluate(const BeamProblem& problem, double x);

}  // namespace trammel::references::manufactured
