#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "solver/assembly/constraints.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

/// Sums symmetric element matrices of unconstrained coordinates to a matrix of the free ones,
/// through T's rows. Entries at the same place are added in the order in which they came.
class Projection {
 public:
  explicit Projection(const Constraints& constraints) : T_(constraints.T) {}

  void reserve(std::size_t entries) { entries_.reserve(entries); }

  template <std::size_t n, class Matrix>
  void add(const std::array<Index, n>& coordinates, const Matrix& k) {
    using Row = RowMajorMatrix::InnerIterator;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        const double value = k(static_cast<Index>(i), static_cast<Index>(j));
        if (coordinates[i] < 0 || coordinates[j] < 0 || value == 0) continue;
        for (Row a(T_, coordinates[i]); a; ++a) {
          for (Row b(T_, coordinates[j]); b; ++b)
            if (b.col() <= a.col()) add(a.col(), b.col(), a.value() * value * b.value());
        }
      }
    }
  }
  /// Adds to an entry of the lower triangle.
  void add(Index i, Index j, double value) {
    entries_.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  }

  /// Both triangles.
  [[nodiscard]] SparseMatrix build() const {
    SparseMatrix lower(T_.cols(), T_.cols());
    lower.setFromTriplets(entries_.begin(), entries_.end());
    return lower.selfadjointView<Eigen::Lower>();
  }

 private:
  const RowMajorMatrix& T_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace trammel::solver
