#pragma once

#include <Eigen/Core>

#include "solver/linear/system.h"

namespace trammel::solver {

/// Rows of an equation of a system for one or more states: the sum of the terms of each row and the
/// sum of their magnitudes. Stiffness and inertia are summed over element matrices that are formed
/// afresh. A coordinate counts with at least a thousandth of the largest motion of its state
/// (rotations times the model's size), because a row in which only round-off moves cannot be
/// judged. Scalar is double or, for damped vibration, std::complex<double>.
template <class Scalar>
class RowBalance {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit RowBalance(const System& system, Index states = 1);

  /// Adds K u and M a of the unconstrained coordinates, one column per state.
  void add_stiffness(const Matrix& u);
  void add_inertia(const Matrix& acceleration);
  /// Adds forces on the unconstrained coordinates [N, N m].
  void add_load(const Matrix& load);
  /// Adds A q of the free coordinates.
  void add(const SparseMatrix& A, const Matrix& q);
  /// Adds magnitudes of the terms of which an added term is itself the sum.
  void add_terms(const Eigen::VectorXd& magnitudes) { terms_ += magnitudes; }

  /// Largest |row| over its terms, in the free coordinates: the smallest relative change of
  /// matrices and loads for which the states are exact. Source: Oettli and Prager (1964).
  [[nodiscard]] double backward_error() const;
  /// |rows| of the first state, at least the round-off error of their terms, over |load|, in the
  /// free coordinates; the stiffness makes forces and moments comparable.
  [[nodiscard]] double residual_over_load() const;

  /// Sums of the terms' magnitudes on the unconstrained coordinates.
  [[nodiscard]] const Eigen::MatrixXd& terms() const { return terms_; }

 private:
  /// Magnitudes of u, each at least `kLeastShare` of the largest of its column.
  [[nodiscard]] Eigen::MatrixXd sizes_of(const Matrix& u) const;
  [[nodiscard]] Matrix rows() const;
  [[nodiscard]] Eigen::MatrixXd row_terms() const;

  const System& system_;
  Eigen::VectorXd length_;  // per unit of each unconstrained coordinate [m]
  Matrix sum_, free_sum_;
  Eigen::MatrixXd terms_, free_terms_;
};

// Viscous damping: what its numbers mean, and its matrix.

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
