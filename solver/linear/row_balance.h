#pragma once

#include <Eigen/Core>

#include "solver/linear/system.h"

namespace trammel::solver {

/// Balance of the rows of an equation of motion for one or more states. It accumulates the sum of
/// the terms of each row and the sum of their magnitudes. Stiffness and inertia are summed over
/// element matrices that are computed again. Each coordinate counts with at least `kLeastFraction`
/// of the largest motion of its state (rotations times the model size). Otherwise there would be no
/// scale for rows whose motions are only round-off errors. Scalar is double or, for damped
/// vibration, `std::complex<double>`.
template <class Scalar>
class RowBalance {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit RowBalance(const System& system, Index states = 1);

  /// Adds K u of the unconstrained coordinates, one column per state.
  void add_stiffness(const Matrix& u);
  /// Adds M a of the unconstrained coordinates, one column per state.
  void add_inertia(const Matrix& acceleration);
  /// Adds forces on the unconstrained coordinates [N, N m].
  void add_load(const Matrix& load);
  /// Adds A q of the free coordinates.
  void add(const SparseMatrix& A, const Matrix& q);
  /// Adds the magnitudes of the terms of which an added term is the sum.
  void add_terms(const Eigen::VectorXd& magnitudes) { terms_ += magnitudes; }

  /// Returns the largest |row| over the sum of magnitudes of its terms, in the free coordinates. It
  /// is the smallest relative change of matrices and loads for which the states are exact.
  /// Source: Oettli and Prager (1964).
  [[nodiscard]] double backward_error() const;
  /// Returns |rows| of the first state over |load|, in the free coordinates. |rows| is at least the
  /// round-off error of the terms. The diagonal stiffness scales forces and moments to make them
  /// comparable.
  [[nodiscard]] double residual_over_load() const;

  /// Returns the sums of the magnitudes of the terms on the unconstrained coordinates.
  [[nodiscard]] const Eigen::MatrixXd& terms() const { return terms_; }

 private:
  /// Returns the magnitudes of u, each at least `kLeastFraction` of the largest of its column.
  [[nodiscard]] Eigen::MatrixXd sizes_of(const Matrix& u) const;
  [[nodiscard]] Matrix rows() const;
  [[nodiscard]] Eigen::MatrixXd row_terms() const;

  const System& system_;
  Eigen::VectorXd length_;  // length per unit of each unconstrained coordinate [m]
  Matrix sum_, free_sum_;
  Eigen::MatrixXd terms_, free_terms_;
};

// Viscous damping: its parameters and its matrix.

/// Rayleigh damping, C = mass * M + stiffness * K (paper Eq. 19 with w1 and w2).
struct RayleighDamping {
  double mass = 0;       ///< >= 0 [1/s]
  double stiffness = 0;  ///< >= 0 [s]
};

/// Returns the damping ratio [-], (mass / w + stiffness * w) / 2.
/// @param damping  factors of mass and stiffness.
/// @param omega  w > 0 [rad/s].
[[nodiscard]] double damping_ratio(const RayleighDamping& damping, double omega);

/// Returns the decay rates ratio * w = (mass + stiffness * w^2) / 2 [1/s], also at w = 0.
[[nodiscard]] Eigen::VectorXd decay_rates(const RayleighDamping& damping,
                                          const Eigen::VectorXd& omega);

/// Returns the angular frequency above which modes do not vibrate, because their damping ratio is 1
/// or more [rad/s]:
///
///   w = (1 + sqrt(1 - mass * stiffness)) / stiffness.
///
/// It is infinite if the stiffness factor is zero. It is 1 / stiffness if mass * stiffness >= 1.
/// Then no mode vibrates.
[[nodiscard]] double overdamping_frequency(const RayleighDamping& damping);

/// Returns mass * M + stiffness * K on the union of both patterns.
[[nodiscard]] SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                                          const SparseMatrix& K);

/// Returns the matrix of modal damping, with x^T M x = 1:
///
///   \f[ C = \sum_{\text{modes}} 2 \zeta \omega (M x)(M x)^T. \f]
///
/// The given modes have their damping ratio, and all others have zero. The matrix is dense in the
/// coordinates that the modes move. Large models use `superpose` instead.
/// @param M  mass matrix.
/// @param omega  angular frequency of each mode [rad/s].
/// @param shape  coordinate x mode.
/// @param ratio  damping ratio of each mode [-].
/// @throws ModelError  if the sizes differ.
[[nodiscard]] SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                                const Eigen::MatrixXd& shape,
                                                const Eigen::VectorXd& ratio);

/// Rayleigh damping and damping of some modes on the free coordinates.
struct ViscousDamping {
  RayleighDamping rayleigh;
  Eigen::VectorXd omega;  ///< of the damped modes [rad/s]
  Eigen::VectorXd ratio;  ///< damping ratio of each mode [-]
  Eigen::MatrixXd shape;  ///< coordinate x mode, x^T M x = 1
};

/// Returns the acceleration whose inertia forces equal part of the damping forces at velocities v:
///
///   mass v + sum over modes of 2 ratio w x (M x)^T v.
///
/// The remaining part of C v is stiffness K v.
[[nodiscard]] Eigen::VectorXd damping_acceleration(const ViscousDamping& damping,
                                                   const SparseMatrix& M, const Eigen::VectorXd& v);

}  // namespace trammel::solver
