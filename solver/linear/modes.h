#pragma once

#include <Eigen/Core>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct ModesOptions {
  Index count = 6;
  EigenMethod method = EigenMethod::automatic;  ///< automatic: dense for small models
};

/// Result of free vibration, K x = w^2 M x with x^T M x = 1 (Varalakshmi & Srinivas 2017, Eq. 28,
/// 29, 33).
///
/// Frequencies are Rayleigh quotients. Their strain energy is summed over the deformations of the
/// elements (element_operators.h). Inverse iteration improves the mode shapes with residuals from
/// the same deformations. The round-off error of a frequency grows about with the square of the
/// number of elements per wavelength, as deformations lose digits. It does not grow with the
/// condition number of K, which is proportional to the fourth power of this number.
struct ModalSolution {
  /// Outcome. singular: a massless part moves freely, or the loads of a prestressed model reach the
  /// buckling load. not_converged: a residual exceeds its limit. Residual::mode_count is such a
  /// residual, if Sylvester's law of inertia counts more modes than were computed.
  Outcome outcome;
  Eigen::VectorXd
      frequency;  ///< ascending, including copies of repeated frequencies [Hz]; rigid modes have 0
  /// Estimated relative round-off error of each frequency [-]. It is half the relative error of
  /// w^2, which is a sum of two terms: the effect of rounding the mode shape on its strain energy
  /// (`strain_energy_roundoff`) over w^2, and the estimated error of the eigenvalue iteration.
  Eigen::VectorXd roundoff;
  Eigen::MatrixXd shape;             ///< free coordinate x mode; see node_motion
  Index zero_energy_mode_count = 0;  ///< number of leading frequencies that are zero
  Evidence evidence;
  Counters counters;
};

/// Computes the lowest natural frequencies and mode shapes.
[[nodiscard]] ModalSolution solve_modes(const System& system, const ModesOptions& options);

/// Computes small vibrations about the loaded equilibrium, (K + K_G) x = w^2 M x. K_G follows from
/// the forces of second-order statics. The displacements of the equilibrium are small, so that the
/// geometry is undeformed. If no stable equilibrium exists, the result has the outcome of statics.
[[nodiscard]] ModalSolution solve_prestressed_modes(const System& system,
                                                    const ModesOptions& options);

/// Makes the zero-energy modes in the columns of Z orthonormal in the mass matrix, Z^T M Z = I.
/// Returns false if one of the modes moves no mass.
[[nodiscard]] bool mass_orthonormalize(const System& system, Eigen::MatrixXd& Z);

/// Returns the number of natural frequencies below `frequency`, including copies of repeated
/// frequencies and rigid modes. The count uses the negative pivots of K - (2 pi f)^2 M (Sylvester).
/// The result is empty if the factorization is dominated by round-off, for example at a natural
/// frequency.
/// @param system  assembled model.
/// @param frequency  f [Hz].
[[nodiscard]] std::optional<Index> sturm_count(const System& system, double frequency);

}  // namespace trammel::solver
