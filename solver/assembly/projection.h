#pragma once

#include <Eigen/SparseCore>
#include <array>

#include "solver/assembly/constraints.h"
#include "solver/linalg/symmetric_builder.h"

namespace trammel::solver {

/// Adds element matrices of unconstrained coordinates to a matrix of free ones, through T's rows.
class Projection {
 public:
  Projection(const Constraints& constraints, SymmetricBuilder& builder)
      : T_(constraints.T), builder_(builder) {}

  template <std::size_t n, class Matrix>
  void add(const std::array<Index, n>& coordinates, const Matrix& k) {
    for (std::size_t i = 0; i < n; ++i) {
      if (coordinates[i] < 0) continue;
      for (std::size_t j = 0; j <= i; ++j) {
        const double value = k(static_cast<Index>(i), static_cast<Index>(j));
        if (coordinates[j] >= 0 && value != 0)
          add_pair(coordinates[i], coordinates[j], value, i == j);
      }
    }
  }

 private:
  using Row = RowMajorMatrix::InnerIterator;

  /// k u_i u_j + k u_j u_i, or k u_i^2 on the diagonal, in terms of q.
  void add_pair(Index i, Index j, double k, bool diagonal) {
    for (Row a(T_, i); a; ++a) {
      for (Row b(T_, j); b; ++b) {
        const double value = a.value() * k * b.value();
        if (diagonal) {
          if (b.col() <= a.col()) builder_.add(a.col(), b.col(), value);
        } else {
          builder_.add(a.col(), b.col(), a.col() == b.col() ? 2 * value : value);
        }
      }
    }
  }

  const RowMajorMatrix& T_;
  SymmetricBuilder& builder_;
};

}  // namespace trammel::solver
