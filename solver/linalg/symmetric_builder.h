#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <vector>

namespace trammel::solver {

/// Collects the lower triangle of a symmetric matrix entry by entry and returns both triangles.
/// Entries at the same place are added in the order in which they came.
class SymmetricBuilder {
 public:
  explicit SymmetricBuilder(Eigen::Index size) : size_(size) {}

  /// Adds the value to both (i, j) and (j, i); each pair is added once.
  void add(Eigen::Index i, Eigen::Index j, double value) {
    entries_.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)),
                          value);
  }
  void reserve(std::size_t entries) { entries_.reserve(entries); }

  [[nodiscard]] Eigen::SparseMatrix<double> build() const {
    Eigen::SparseMatrix<double> lower(size_, size_);
    lower.setFromTriplets(entries_.begin(), entries_.end());
    return lower.selfadjointView<Eigen::Lower>();
  }

 private:
  Eigen::Index size_;
  std::vector<Eigen::Triplet<double>> entries_;
};

}  // namespace trammel::solver
