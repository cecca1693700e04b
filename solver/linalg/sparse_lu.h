#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace trammel::solver {

/// L U with row exchanges of a sparse square matrix, compiled once; Scalar is double or
/// std::complex<double>. The first `factorize` computes the ordering, which is kept: later matrices
/// have the same pattern.
template <class Scalar>
class SparseLu {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  SparseLu();
  /// Returns false if A is singular or not finite; then `solve` must not be called.
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<Scalar>& A);
  [[nodiscard]] Vector solve(const Vector& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors, void (*)(Factors*)> factors_;
};

}  // namespace trammel::solver
