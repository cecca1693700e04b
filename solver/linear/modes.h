#pragma once

#include <Eigen/Core>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Options of a vibration analysis.
struct ModesOptions {
  Index count = 6;
  EigenMethod method = EigenMethod::automatic;  ///< automatic: dense for small models
};

/// Result of free vibration, K x = w^2 M x (paper Eq. 28, 29) with x^T M x = 1 (Eq. 33).
///
/// Frequencies are Rayleigh quotients. Their strain energy is summed over the deformations of the
/// elements (element_operators.h). Inverse iteration with the same residuals improves the vectors.
/// The round-off error of a frequency grows with the loss of digits in the deformations, about the
/// square of the number of elements per wavelength. It does not grow with the condition number of
/// K, which is the fourth power of that number.
struct ModalSolution {
  /// singular: a massless part moves freely; not_converged: fewer modes than the inertia count
  Outcome outcome;
  Eigen::VectorXd
      frequency;  ///< ascending, including copies of repeated frequencies [Hz]; rigid modes have 0
  /// Estimated relative round-off error of each frequency [-]. It is half of 2 eps sum |d|^T C |B|
  /// |u| / w^2, plus the error estimated from the residual. The first term bounds the effect on the
  /// strain energy of rounding the mode u (element_operators.h).
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
/// geometry is undeformed. The outcome is that of statics if there is no stable equilibrium.
[[nodiscard]] ModalSolution solve_prestressed_modes(const System& system,
                                                    const ModesOptions& options);

/// Makes the columns of Z, which are zero-energy modes, orthonormal in the mass matrix. Returns
/// false if one of them moves no mass.
[[nodiscard]] bool mass_orthonormalize(const System& system, Eigen::MatrixXd& Z);

/// Returns the number of natural frequencies below `frequency`, including copies of repeated
/// frequencies and rigid modes. The count uses the negative pivots of K - (2 pi f)^2 M (Sylvester).
/// The result is empty if the factorization is dominated by round-off, for example at a natural
/// frequency.
/// @param system  assembled model.
/// @param frequency  f [Hz].
[[nodiscard]] std::optional<Index> sturm_count(const System& system, double frequency);

}  // namespace trammel::solver
