#pragma once

#include <Eigen/Core>

#include "solver/linear/system.h"

namespace trammel::solver {

/// Residuals of the rows of an equation of motion for one or more states. For each row, the sum of
/// the terms (residual) and the sum of their magnitudes (scale) are accumulated. Stiffness and
/// inertia are summed over element matrices that are computed again. In the scale, each coordinate
/// counts with at least `kLeastFraction` of the largest motion of its state (rotations times the
/// model size). Otherwise the scale of a row could consist of round-off errors only. Scalar is
/// double or, for damped vibration, `std::complex<double>`.
template <class Scalar>
class RowBalance {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit RowBalance(const System& system, Index states = 1);

  /// Adds the elastic forces K u of the unconstrained coordinates u, one column per state.
  void add_elastic_forces(const Matrix& u);
  /// Adds the inertia forces M a of accelerations a of the coordinates u, one column per state.
  void add_inertia_forces(const Matrix& acceleration);
  /// Adds forces on the unconstrained coordinates [N, N m].
  void add_load(const Matrix& load);
  /// Adds the forces A q on the free coordinates q.
  void add(const SparseMatrix& A, const Matrix& q);
  /// Adds magnitudes of terms to the scales of the rows of the unconstrained coordinates. Use it if
  /// an added term is a small difference of two larger values, with the magnitudes of these values.
  void add_term_magnitudes(const Eigen::VectorXd& magnitudes) { terms_ += magnitudes; }

  /// Returns the largest ratio of a residual to its scale over all rows of the free coordinates.
  /// The states would be exact solutions if matrices and loads were changed by at most this
  /// fraction.
  /// Source: Oettli and Prager (1964).
  [[nodiscard]] double backward_error() const;
  /// Returns the norm of the residuals of the first state over the norm of the load, in the free
  /// coordinates. A residual counts at least with the round-off error of its terms. The diagonal
  /// stiffness scales forces and moments to make them comparable.
  [[nodiscard]] double residual_over_load() const;

  /// Returns the scale of each row of the unconstrained coordinates: the sum of the magnitudes of
  /// its terms [N, N m].
  [[nodiscard]] const Eigen::MatrixXd& magnitudes() const { return terms_; }

 private:
  /// Returns the magnitudes of the entries of u, increased to at least `kLeastFraction` of the
  /// largest magnitude in the same column.
  [[nodiscard]] Eigen::MatrixXd bounded_magnitudes(const Matrix& u) const;
  [[nodiscard]] Matrix row_residuals() const;
  [[nodiscard]] Eigen::MatrixXd row_term_magnitudes() const;

  const System& system_;
  Eigen::VectorXd length_;  // length per unit of each unconstrained coordinate [m]
  Matrix sum_, free_sum_;
  Eigen::MatrixXd terms_, free_terms_;
};

// Viscous damping: parameters and damping matrix.

/// Rayleigh damping, C = mass * M + stiffness * K. The factors are w1 and w2 in Varalakshmi &
/// Srinivas (2017), Eq. 19.
struct RayleighDamping {
  double mass = 0;       ///< >= 0 [1/s]
  double stiffness = 0;  ///< >= 0 [s]
};

/// Returns the damping ratio of Rayleigh damping [-], (mass / w + stiffness * w) / 2.
/// @param damping  factors of the mass and stiffness matrices.
/// @param omega  angular frequency w > 0 [rad/s].
[[nodiscard]] double damping_ratio(const RayleighDamping& damping, double omega);

/// Returns the decay rates of modes, damping ratio * w = (mass + stiffness * w^2) / 2 [1/s]. The
/// frequency w of a mode may be 0.
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

/// Returns the Rayleigh damping matrix mass * M + stiffness * K, with all entries of M and K
/// stored.
[[nodiscard]] SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                                          const SparseMatrix& K);

/// Returns the matrix of modal damping, with x^T M x = 1:
///
///   \f[ C = \sum_{\text{modes}} 2 \zeta \omega (M x)(M x)^T. \f]
///
/// All other modes have no damping. The matrix is dense in the coordinates that the modes move.
/// Large models use `superpose` instead.
/// @param M  mass matrix.
/// @param omega  angular frequency of each mode [rad/s].
/// @param shape  mode shapes, coordinate x mode.
/// @param ratio  damping ratio of each mode [-].
/// @throws ModelError  if the sizes differ.
[[nodiscard]] SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                                const Eigen::MatrixXd& shape,
                                                const Eigen::VectorXd& ratio);

/// Viscous damping on the free coordinates: Rayleigh damping plus modal damping of some modes.
struct ViscousDamping {
  RayleighDamping rayleigh;
  Eigen::VectorXd omega;  ///< angular frequencies of these modes [rad/s]
  Eigen::VectorXd ratio;  ///< damping ratio of each of these modes [-]
  Eigen::MatrixXd shape;  ///< coordinate x mode, x^T M x = 1
};

/// Returns the acceleration whose inertia forces equal the mass-proportional and modal damping
/// forces at velocities v:
///
///   mass v + sum over modes of 2 ratio w x (M x)^T v.
///
/// The stiffness-proportional damping force, stiffness * K v, is not included.
[[nodiscard]] Eigen::VectorXd damping_acceleration(const ViscousDamping& damping,
                                                   const SparseMatrix& M, const Eigen::VectorXd& v);

}  // namespace trammel::solver
