#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace trammel::solver {

/// L U with row exchanges of a sparse square matrix, compiled once; Scalar is double or
/// std::complex<double>. The ordering is made by the first `factorize` and kept: later matrices
/// have the same pattern.
template <class Scalar>
class SparseLu {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  SparseLu();
  ~SparseLu();
  SparseLu(SparseLu&&) noexcept;
  SparseLu& operator=(SparseLu&&) noexcept;
  SparseLu(const SparseLu&) = delete;
  SparseLu& operator=(const SparseLu&) = delete;

  /// False where A is singular or not finite; then nothing may be solved.
  [[nodiscard]] bool factorize(const Eigen::SparseMatrix<Scalar>& A);
  [[nodiscard]] Vector solve(const Vector& b) const;

 private:
  struct Factors;
  std::unique_ptr<Factors> factors_;
};

}  // namespace trammel::solver
