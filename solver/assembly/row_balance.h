#pragma once

#include <Eigen/Core>

#include "solver/assembly/system.h"

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

}  // namespace trammel::solver
