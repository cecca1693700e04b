#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"

/// Viscous damping: what its numbers mean, and its matrix.
namespace trammel::solver {

/// C = mass * M + stiffness * K (paper Eq. 19, where they are w1 and w2).
struct RayleighDamping {
  double mass = 0;       ///< >= 0 [1/s]
  double stiffness = 0;  ///< >= 0 [s]
};

/// ratio(w) = (mass / w + stiffness * w) / 2.   @param omega  > 0 [rad/s]
[[nodiscard]] double damping_ratio(const RayleighDamping& damping, double omega);

/// Half of the modal damping, ratio * w = (mass + stiffness * w^2) / 2 [1/s]; also at w = 0.
[[nodiscard]] Eigen::VectorXd decay_rates(const RayleighDamping& damping,
                                          const Eigen::VectorXd& omega);

/// From where on modes do not vibrate, for their ratio is 1 or more [rad/s]:
///   w = (1 + sqrt(1 - mass * stiffness)) / stiffness,
/// infinite without stiffness factor; 1 / stiffness where with mass * stiffness >= 1 none vibrates.
[[nodiscard]] double overdamped_above(const RayleighDamping& damping);

/// mass * M + stiffness * K, on the union of the two patterns.
[[nodiscard]] SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                                          const SparseMatrix& K);

/// Modal damping as a matrix, C = sum over modes of 2 ratio w (M x)(M x)^T with x^T M x = 1: the
/// given modes have their ratio, all others none. Dense in the coordinates that the modes move;
/// large models take `superpose` instead.
/// @param omega  [rad/s];  @param shape  coordinate x mode;  @param ratio  mode
/// @throws ModelError  where the sizes differ.
[[nodiscard]] SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                                const Eigen::MatrixXd& shape,
                                                const Eigen::VectorXd& ratio);

/// Rayleigh damping and that of some modes, all on the free coordinates.
struct ViscousDamping {
  RayleighDamping rayleigh;
  Eigen::VectorXd omega;  ///< of the damped modes [rad/s]
  Eigen::VectorXd ratio;  ///< mode
  Eigen::MatrixXd shape;  ///< coordinate x mode, x^T M x = 1
};

/// What of the damping forces is the inertia force of some acceleration, at velocities v:
///   mass v + sum over modes of 2 ratio w x (M x)^T v.
/// The rest of C v is stiffness K v.
[[nodiscard]] Eigen::VectorXd damping_acceleration(const ViscousDamping& damping,
                                                   const SparseMatrix& M, const Eigen::VectorXd& v);

}  // namespace trammel::solver
