#pragma once

#include <Eigen/Core>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// The rows of an equation of a system, summed element by element from matrices formed afresh, each
/// with the sum of its terms' magnitudes. Complex, for vibration with damping. A coordinate counts
/// with at least a thousandth of the largest motion (rotations times the model's size): where
/// nothing moves but rounding, a row has no digits to be judged by.
class EquationRows {
 public:
  explicit EquationRows(const System& system);

  /// @param u  unconstrained coordinates
  void add_stiffness(const Eigen::VectorXcd& u, std::complex<double> factor = 1);
  void add_inertia(const Eigen::VectorXcd& u, std::complex<double> factor = 1);
  /// @param load  on the unconstrained coordinates [N, N m]
  void add_load(const Eigen::VectorXcd& load, std::complex<double> factor = 1);
  /// @param A  on the free coordinates, as q is
  void add(const SparseMatrix& A, const Eigen::VectorXcd& q, std::complex<double> factor = 1);
  /// @param magnitudes  of terms that an added one is itself the sum of, unconstrained coordinates
  void add_terms(const Eigen::VectorXd& magnitudes);

  /// Largest |row| over its terms, in the free coordinates: the least relative change of matrices
  /// and loads for which the solution is exact. Source: Oettli and Prager (1964).
  [[nodiscard]] double backward_error() const;
  /// |rows|, at least the round-off error of their terms, over |load|, in the free coordinates;
  /// forces and moments are made alike by the stiffness.
  [[nodiscard]] double residual_over_load() const;

  /// Sums of the terms' magnitudes on the unconstrained coordinates.
  [[nodiscard]] const Eigen::VectorXd& terms() const { return terms_; }

 private:
  template <class Coordinates, class Matrix>
  void add_element(const Coordinates& coordinates, const Matrix& k, const Eigen::VectorXcd& u,
                   const Eigen::VectorXd& size, std::complex<double> factor);

  const System& system_;
  double model_size_;
  Eigen::VectorXcd sum_, free_sum_;
  Eigen::VectorXd terms_, free_terms_;
};

/// Largest backward error of (K + K_G) q = w^2 M q; no K_G where it is null.
/// @param shapes  the q, a column each; @param w2  w^2 of each [1/s^2]
[[nodiscard]] double mode_backward_error(const System& system, const SparseMatrix* K_G,
                                         const Eigen::MatrixXd& shapes, const Eigen::VectorXd& w2);

}  // namespace trammel::solver
