#pragma once

#include <Eigen/Core>

#include "solver/linear/system.h"

namespace trammel::solver {

/// Residuals of the rows of an equation of motion for one or more states. For each row, the sum of
/// the terms (residual) and the sum of their magnitudes (scale) are accumulated. Stiffness and
/// inertia terms are sums over element matrices that are computed again. In the scale, each
/// coordinate has at least the fraction `kLeastFraction` of the largest displacement of its state
/// (rotations times the model size). Otherwise the scale of a row could consist of round-off errors
/// only. Scalar is double or, for damped vibration, `std::complex<double>`.
template <class Scalar>
class RowBalance {
 public:
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit RowBalance(const System& system, Index states = 1);

  /// Adds the elastic forces K u of the unconstrained coordinates u, one column per state.
  void add_elastic_forces(const Matrix& u);
  /// Adds the inertia forces M a of accelerations a of the coordinates u, one column per state.
  void add_inertia_forces(const Matrix& acceleration);
  /// Adds forces on the unconstrained coordinates [N, N m], one column per state.
  void add_load(const Matrix& load);
  /// Adds the forces A q on the free coordinates q, one column per state.
  void add(const SparseMatrix& A, const Matrix& q);
  /// Adds magnitudes of terms to the scales of the rows of the unconstrained coordinates. This
  /// function is required if an added term is a small difference of two larger values. The
  /// magnitudes are those of the larger values.
  void add_term_magnitudes(const Eigen::VectorXd& magnitudes) { terms_ += magnitudes; }

  /// Returns the largest ratio of a residual to its scale over all rows of the free coordinates.
  /// The states would be exact solutions if matrices and loads were changed by at most this
  /// fraction.
  /// Source: Oettli and Prager (1964).
  [[nodiscard]] double backward_error() const;
  /// Returns the norm of the residuals of the first state over the norm of the load, in the free
  /// coordinates. Each residual is at least the round-off error of its terms. The diagonal
  /// stiffness scales forces and moments to make them comparable.
  [[nodiscard]] double residual_over_load() const;

  /// Returns the scale of each row of the unconstrained coordinates: the sum of the magnitudes of
  /// the terms of the row [N, N m].
  [[nodiscard]] const Eigen::MatrixXd& magnitudes() const { return terms_; }

 private:
  /// Returns the magnitudes of the components of u. Each magnitude is at least `kLeastFraction` of
  /// the largest magnitude in the same column, with rotations times the model size.
  [[nodiscard]] Eigen::MatrixXd bounded_magnitudes(const Matrix& u) const;
  [[nodiscard]] Matrix row_residuals() const;
  [[nodiscard]] Eigen::MatrixXd row_term_magnitudes() const;

  const System& system_;
  // Length per unit of each unconstrained coordinate: 1, or the model size for rotations [m].
  Eigen::VectorXd length_;
  Matrix sum_, free_sum_;
  Eigen::MatrixXd terms_, free_terms_;
};

// Viscous damping: parameters and damping matrix.

/// Rayleigh damping, C = mass * M + stiffness * K. The factors are w1 and w2 in Varalakshmi &
/// Srinivas (2017), Eq. 19.
struct RayleighDamping {
  /// Coefficient of the mass matrix M in C = mass * M + stiffness * K, >= 0 [1/s].
  double mass = 0;
  /// Coefficient of the stiffness matrix K in C = mass * M + stiffness * K, >= 0 [s].
  double stiffness = 0;
};

/// Returns the damping ratio of Rayleigh damping [-], (mass / w + stiffness * w) / 2.
/// @param damping  coefficients `mass` and `stiffness` of the damping matrix mass * M + stiffness *
///   K.
/// @param omega  angular frequency w > 0 [rad/s].
[[nodiscard]] double damping_ratio(const RayleighDamping& damping, double omega);

/// Returns the decay rates damping ratio * w = (mass + stiffness * w^2) / 2 [1/s] of modes under
/// Rayleigh damping. w is the angular frequency of a mode. A rigid mode has w = 0.
[[nodiscard]] Eigen::VectorXd decay_rates(const RayleighDamping& damping,
                                          const Eigen::VectorXd& omega);

/// Returns the angular frequency [rad/s] above which modes do not vibrate, because their damping
/// ratio is 1 or more:
///
///   w = (1 + sqrt(1 - mass * stiffness)) / stiffness.
///
/// The result is infinite if `stiffness` is zero. The result is 1 / stiffness if mass * stiffness
/// >= 1; in this case no mode vibrates.
[[nodiscard]] double overdamping_frequency(const RayleighDamping& damping);

/// Returns the Rayleigh damping matrix mass * M + stiffness * K. Its sparsity pattern contains all
/// stored entries of M and K.
[[nodiscard]] SparseMatrix damping_matrix(const RayleighDamping& damping, const SparseMatrix& M,
                                          const SparseMatrix& K);

/// Returns the damping matrix C of modal damping, for modes x with x^T M x = 1:
///
///   \f[ C = \sum_{\text{modes}} 2 \zeta \omega (M x)(M x)^T. \f]
///
/// All modes that are not in `shape` have no damping. The matrix is dense in the coordinates that
/// the modes move. For large models, `superpose` is used instead.
/// @param M  mass matrix.
/// @param omega  angular frequency of each mode [rad/s].
/// @param shape  mode shapes, coordinate x mode.
/// @param ratio  damping ratio of each mode [-].
/// @throws ModelError  if the sizes of M, omega, shape and ratio differ.
[[nodiscard]] SparseMatrix modal_damping_matrix(const SparseMatrix& M, const Eigen::VectorXd& omega,
                                                const Eigen::MatrixXd& shape,
                                                const Eigen::VectorXd& ratio);

/// Viscous damping on the free coordinates: Rayleigh damping plus modal damping of selected modes.
struct ViscousDamping {
  RayleighDamping rayleigh;
  /// Angular frequencies of the modes with modal damping [rad/s].
  Eigen::VectorXd omega;
  /// Modal damping ratios [-].
  Eigen::VectorXd ratio;
  /// Shapes of the modes with modal damping, coordinate x mode, x^T M x = 1.
  Eigen::MatrixXd shape;
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
