#pragma once

#include "harness/statics_modes/warning.h"
#include "solver/linear/statics.h"
#include "solver/linear/system.h"

/// Validity ranges of the theories, and warnings of solutions outside these ranges.
namespace trammel::harness {

/// Largest rotation for which linear theory is accepted [rad]. The theory approximates cos(theta)
/// by 1 and sin(theta) by theta. At the limit it neglects theta^2 / 2 = 0.5 %.
inline constexpr double kMaxLinearRotation = 0.1;

/// Largest axial or shear strain for which the linear law of a section (axial force = EA times
/// extension) is accepted. The law ignores changes of the cross-section. At the limit, the measures
/// of strain (engineering, logarithmic, Green) differ by 5 %, as do the stresses on the section.
inline constexpr double kMaxStrain = 0.1;

/// Returns the largest rotation of a node, a member's end, a chord or a triangle [rad].
/// @param u  unconstrained coordinates
[[nodiscard]] double largest_rotation(const solver::System& system, const Eigen::VectorXd& u);

/// Returns the largest rotation of nodes and members' ends only [rad].
[[nodiscard]] double largest_rotation(const solver::StaticSolution& solution);

/// Warns if the largest rotation is outside the validity range of linear theory.
/// @param rotation  [rad]
void warn_of_rotation(double rotation, std::vector<Warning>& warnings);

/// Warns if an axial or shear strain at the ends of the members exceeds `kMaxStrain`.
void warn_of_strain(const solver::Model& model, const solver::StaticSolution& solution,
                    std::vector<Warning>& warnings);

/// Limit of the amplification of displacements near a buckling load. Errors of the stiffness are
/// amplified by the same factor, so that one digit is lost at the limit.
inline constexpr double kMaxAmplification = 10;
void warn_of_near_buckling(const solver::StaticSolution& solution, std::vector<Warning>& warnings);

/// Limit of the dimensionless wave number beta l of an element with cubic deflection. A half wave
/// of bending has the length pi / beta, with beta^4 = w^2 m / EI. The limit is half of a half wave.
inline constexpr double kMaxWaveNumber = 1.5708;
/// Returns the highest frequency with at least two elements per half wave of bending [Hz]; infinite
/// if no element bends.
[[nodiscard]] double resolved_frequency(const solver::Mesh& mesh);
/// Warns if the elements are too long for the highest mode.
/// @param frequency  highest of the reported modes [Hz]
void warn_of_wave_length(const solver::System& system, double frequency,
                         std::vector<Warning>& warnings);

/// Limit of the ratio of the stiffnesses at both ends of an element of a tapered member. The
/// element has a constant section: the section of the member at the middle of the element. At the
/// limit, the error of the axial flexibility of the element is about 1 %.
inline constexpr double kMaxTaperRatio = 1.5;
void warn_of_taper(const solver::Model& model, std::vector<Warning>& warnings);

/// Warns if the round-off error of a frequency exceeds a thousandth of the frequency.
/// @param frequency_roundoff  relative round-off error
void warn_of_roundoff(double frequency_roundoff, std::vector<Warning>& warnings);

/// Warns of redundant constraints among supports, rigid bodies and inextensible members.
/// Equilibrium does not determine how the constraints share the loads. The reported forces are one
/// of many solutions.
void warn_of_redundant_constraints(const solver::System& system, std::vector<Warning>& warnings);
/// Warns if there are redundant constraints.
/// @param redundant  number of redundant constraints
void warn_of_redundant_constraints(Eigen::Index redundant, std::vector<Warning>& warnings);

}  // namespace trammel::harness
