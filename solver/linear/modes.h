#pragma once

#include <Eigen/Core>
#include <optional>

#include "solver/linalg/eigenpairs.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

struct ModesOptions {
  Index count = 6;
  EigenMethod method =
      EigenMethod::automatic;  ///< automatic: dense below a few hundred free coordinates
};

/// Free vibration K x = w^2 M x (paper Eq. 28, 29), x^T M x = 1 (Eq. 33).
///
/// Frequencies are Rayleigh quotients whose strain energy is summed over the elements' deformations
/// (see element_operators.h), with vectors improved by inverse iteration with the same residuals:
/// their round-off grows with the digits lost in taking the deformations from the displacements
/// (about the square of the number of elements a wavelength), not with the condition number of K
/// (its fourth power).
struct ModalSolution {
  /// singular: a massless part moves freely; not_converged: fewer modes than the inertia count says
  Outcome outcome;
  Eigen::VectorXd
      frequency;  ///< ascending, copies of repeated ones included [Hz]; rigid motions are 0
  /// Estimate of each frequency's relative round-off error [-]: half of 2 eps sum |d|^T C |B||u|
  /// over w^2 (what rounding the mode to doubles can do to its strain energy), and the error left
  /// by the residual.
  Eigen::VectorXd roundoff;
  Eigen::MatrixXd shape;             ///< free coordinate x mode; see node_motion
  Index zero_energy_mode_count = 0;  ///< how many leading frequencies are zero
  Evidence evidence;
  Counters counters;
};

[[nodiscard]] ModalSolution solve_modes(const System& system, const ModesOptions& options);

/// Small vibration about the state in which the model's loads hold it: (K + K_G) x = w^2 M x, K_G
/// from the forces of second-order statics. The state's displacements are small: the geometry is
/// the undeformed one. Singular without a stable state, for the reason given by statics.
[[nodiscard]] ModalSolution solve_prestressed_modes(const System& system,
                                                    const ModesOptions& options);

/// Makes the columns of Z, free motions of a system, orthonormal in its mass; returns false if one
/// of them moves no mass.
[[nodiscard]] bool orthonormalise(const System& system, Eigen::MatrixXd& Z);

/// Natural frequencies below `frequency` [Hz], copies of repeated ones and rigid motions included,
/// by the negative pivots of K - (2 pi f)^2 M (Sylvester); nothing where the factorization loses
/// its digits, as on a natural frequency.
[[nodiscard]] std::optional<Index> sturm_count(const System& system, double frequency);

}  // namespace trammel::solver
