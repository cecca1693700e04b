#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace trammel::solver {

/// Collects the lower triangle of a symmetric matrix entry by entry and returns it whole. Entries
/// at the same place are added up in the order they came, so that the result is the same every
/// time.
class SymmetricBuilder {
 public:
  explicit SymmetricBuilder(Eigen::Index size) : size_(size) {}

  /// Both (i, j) and (j, i) get the value; give each pair once.
  void add(Eigen::Index i, Eigen::Index j, double value) {
    entries_.push_back(i > j ? Entry{static_cast<int>(i), static_cast<int>(j), value}
                             : Entry{static_cast<int>(j), static_cast<int>(i), value});
  }
  void reserve(std::size_t entries) { entries_.reserve(entries); }

  /// Empties the builder.
  [[nodiscard]] Eigen::SparseMatrix<double> build();

 private:
  struct Entry {
    int row;
    int col;
    double value;
  };
  Eigen::Index size_;
  std::vector<Entry> entries_;
};

}  // namespace trammel::solver
