#pragma once

#include "harness/statics_modes/warning.h"
#include "solver/linear/statics.h"
#include "solver/linear/system.h"

/// How far the theories hold, and warnings of solutions that went farther.
namespace trammel::harness {

/// Linear theory takes cos(theta) as 1 and sin(theta) as theta: up to here [rad] it neglects
/// theta^2 / 2 = 0.5 %.
inline constexpr double kMaxLinearRotation = 0.1;

/// N = EA times the extension takes the section as it was: up to here the measures of strain
/// (engineering, logarithmic, Green's) differ by 5 %, and so do the stresses on the section.
inline constexpr double kMaxStrain = 0.1;

/// Largest rotation of a node, a member's end or a chord, or a triangle [rad].
/// @param u  unconstrained coordinates
[[nodiscard]] double largest_rotation(const solver::System& system, const Eigen::VectorXd& u);

/// The same of what is stated at nodes and members' ends alone.
[[nodiscard]] double largest_rotation(const solver::StaticSolution& solution);

/// @param rotation  [rad]
void warn_of_rotation(double rotation, std::vector<Warning>& warnings);

/// Of |N| / EA at the ends of the members.
void warn_of_strain(const solver::Model& model, const solver::StaticSolution& solution,
                    std::vector<Warning>& warnings);

/// Near a buckling load whatever is wrong with the stiffness counts as much more as displacements
/// grow; up to here that is one digit.
inline constexpr double kMaxAmplification = 10;
void warn_of_amplification(const solver::StaticSolution& solution, std::vector<Warning>& warnings);

/// An element bends as a cubic: up to here it is at most half of a half wave, pi / beta, of bending
/// vibration with beta^4 = w^2 m / EI.
inline constexpr double kMaxWaveNumber = 1.5708;
/// @param frequency  highest of the modes that are reported [Hz]
void warn_of_wave_length(const solver::System& system, double frequency,
                         std::vector<Warning>& warnings);

/// An element of a tapered member has the section at its middle: up to this ratio of the stiffness
/// at its ends the error is about 1 %.
inline constexpr double kMaxTaperRatio = 1.5;
void warn_of_taper(const solver::Model& model, std::vector<Warning>& warnings);

/// @param of_frequency  relative round-off error; beyond a thousandth it is noticed
void warn_of_roundoff(double of_frequency, std::vector<Warning>& warnings);

/// Of supports, rigid bodies and inextensible members that hold what others hold already: how they
/// share the loads is not determined, and what is reported is one way of many.
void warn_of_redundancy(const solver::System& system, std::vector<Warning>& warnings);
/// @param redundant  number of such constraints
void warn_of_redundancy(Eigen::Index redundant, std::vector<Warning>& warnings);

}  // namespace trammel::harness
