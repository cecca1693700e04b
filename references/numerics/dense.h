#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

/// Small dense matrices in extended precision. Boost.Multiprecision brings no linear algebra, and
/// uBLAS of Boost 1.74 does not compile with C++20 for numbers that are not built in.
namespace trammel::references {

template <class T>
class Dense {
 public:
  Dense() = default;
  Dense(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), values_(rows * columns, T(0)) {}

  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  T& operator()(std::size_t i, std::size_t j) { return values_[i * columns_ + j]; }
  const T& operator()(std::size_t i, std::size_t j) const { return values_[i * columns_ + j]; }

 private:
  std::size_t rows_ = 0, columns_ = 0;
  std::vector<T> values_;
};

/// A x.
template <class T>
[[nodiscard]] std::vector<T> product(const Dense<T>& A, const std::vector<T>& x) {
  std::vector<T> y(A.rows(), T(0));
  for (std::size_t i = 0; i < A.rows(); ++i) {
    for (std::size_t j = 0; j < A.columns(); ++j) y[i] += A(i, j) * x[j];
  }
  return y;
}

/// A^T B.
template <class T>
[[nodiscard]] Dense<T> transpose_product(const Dense<T>& A, const Dense<T>& B) {
  Dense<T> C(A.columns(), B.columns());
  for (std::size_t k = 0; k < A.rows(); ++k) {
    for (std::size_t i = 0; i < A.columns(); ++i) {
      if (A(k, i) == 0) continue;
      for (std::size_t j = 0; j < B.columns(); ++j) C(i, j) += A(k, i) * B(k, j);
    }
  }
  return C;
}

/// Solves A x = b by Gaussian elimination with partial pivoting; b becomes x.
/// @returns false where a pivot is below `min_pivot`, that is, where A is singular.
template <class T>
[[nodiscard]] bool solve_in_place(Dense<T> A, std::vector<T>& b, const T& min_pivot) {
  using std::abs;
  const std::size_t n = A.rows();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (abs(A(i, k)) > abs(A(p, k))) p = i;
    }
    if (!(abs(A(p, k)) > min_pivot)) return false;
    for (std::size_t j = k; j < n; ++j) std::swap(A(k, j), A(p, j));
    std::swap(b[k], b[p]);
    for (std::size_t i = k + 1; i < n; ++i) {
      if (A(i, k) == 0) continue;
      const T factor = A(i, k) / A(k, k);
      for (std::size_t j = k; j < n; ++j) A(i, j) -= factor * A(k, j);
      b[i] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] -= A(k, j) * b[j];
    b[k] /= A(k, k);
  }
  return true;
}

/// Determinant of a small matrix by Gaussian elimination with partial pivoting.
template <class T, std::size_t N>
[[nodiscard]] T determinant(std::array<std::array<T, N>, N> m) {
  using std::abs;
  T det = 1;
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t p = k;
    for (std::size_t i = k + 1; i < N; ++i) {
      if (abs(m[i][k]) > abs(m[p][k])) p = i;
    }
    if (p != k) {
      std::swap(m[p], m[k]);
      det = -det;
    }
    det *= m[k][k];
    for (std::size_t i = k + 1; i < N && det != 0; ++i) {
      const T factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j < N; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  return det;
}

}  // namespace trammel::references
