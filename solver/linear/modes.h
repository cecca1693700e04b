#pragma once

#include <Eigen/Core>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct ModesOptions {
  Index count = 6;
  /// automatic: the dense method for small models, otherwise the sparse method.
  EigenMethod method = EigenMethod::automatic;
};

/// Result of free vibration, K x = w^2 M x with x^T M x = 1 (Varalakshmi & Srinivas 2017, Eq. 28,
/// 29, 33).
///
/// Frequencies are Rayleigh quotients. The strain energy of each mode is summed over the
/// deformations of the elements (element_operators.h). Inverse iteration improves the mode shapes
/// with residuals from the same deformations. The round-off error of a frequency grows about with
/// the square of the number of elements per wavelength, because deformations lose digits. The error
/// does not grow with the condition number of K, which is proportional to the fourth power of the
/// number of elements per wavelength.
struct ModalSolution {
  /// Outcome of the analysis. singular: a massless coordinate moves freely, or the loads of a
  /// prestressed model reach the buckling load. not_converged: a residual exceeds its limit.
  /// Residual::mode_count is such a residual: the number of modes that are missing according to
  /// Sylvester's law of inertia or were found twice.
  Outcome outcome;
  Eigen::VectorXd
      frequency;  ///< ascending, including copies of repeated frequencies [Hz]; rigid modes have 0
  /// Estimated relative round-off error of each frequency [-]. This error is half the relative
  /// error of w^2, which is a sum of two terms. The first term is the effect of rounding the mode
  /// shape on its strain energy (`strain_energy_roundoff`) over w^2, the second term the estimated
  /// error of the eigenvalue iteration.
  Eigen::VectorXd roundoff;
  /// Mode shapes, free coordinate x mode; `node_motion` converts a column to node displacements.
  Eigen::MatrixXd shape;
  Index zero_energy_mode_count = 0;  ///< number of leading frequencies that are zero
  Evidence evidence;
  Counters counters;
};

/// Computes the lowest natural frequencies and mode shapes.
[[nodiscard]] ModalSolution solve_modes(const System& system, const ModesOptions& options);

/// Computes small vibrations about the loaded equilibrium, (K + K_G) x = w^2 M x. K_G follows from
/// the internal forces of second-order statics. The displacements of the equilibrium are small, so
/// that the geometry is undeformed. If no stable equilibrium exists, the result has the outcome of
/// statics.
[[nodiscard]] ModalSolution solve_prestressed_modes(const System& system,
                                                    const ModesOptions& options);

/// Makes the zero-energy modes in the columns of Z orthonormal with respect to the mass matrix, Z^T
/// M Z = I. Returns false if a mode, or a combination of modes, moves no mass.
[[nodiscard]] bool mass_orthonormalize(const System& system, Eigen::MatrixXd& Z);

/// Returns the number of natural frequencies below `frequency`, including copies of repeated
/// frequencies and rigid modes. The number of negative pivots of K - (2 pi f)^2 M is counted
/// (Sylvester's law of inertia). The result is empty if the factorization is dominated by round-off
/// errors, for example at a natural frequency.
/// @param system  assembled model.
/// @param frequency  frequency f [Hz].
[[nodiscard]] std::optional<Index> sturm_count(const System& system, double frequency);

}  // namespace trammel::solver
