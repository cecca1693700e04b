#include "solver/linalg/symmetric_builder.h"

namespace trammel::solver {

Eigen::SparseMatrix<double> SymmetricBuilder::build() {
  // Counting sort by row, then by column: linear in the number of entries, and stable.
  const auto n = static_cast<std::size_t>(size_);
  std::vector<Entry> by_row(entries_.size());
  std::vector<std::size_t> start(n + 1, 0);
  for (const Entry& e : entries_) ++start[static_cast<std::size_t>(e.row) + 1];
  for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  for (const Entry& e : entries_) by_row[start[static_cast<std::size_t>(e.row)]++] = e;
  start.assign(n + 1, 0);
  for (const Entry& e : by_row) ++start[static_cast<std::size_t>(e.col) + 1];
  for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
  for (const Entry& e : by_row) entries_[start[static_cast<std::size_t>(e.col)]++] = e;
  by_row = {};

  std::size_t unique = 0;  // sum equal places, in front
  for (const Entry& e : entries_) {
    if (unique > 0 && entries_[unique - 1].row == e.row && entries_[unique - 1].col == e.col) {
      entries_[unique - 1].value += e.value;
    } else {
      entries_[unique++] = e;
    }
  }
  entries_.resize(unique);

  Eigen::SparseMatrix<double> lower(size_, size_);
  lower.reserve(static_cast<Eigen::Index>(unique));
  std::size_t next = 0;
  for (int col = 0; col < static_cast<int>(size_); ++col) {
    lower.startVec(col);
    for (; next < unique && entries_[next].col == col; ++next) {
      lower.insertBack(entries_[next].row, col) = entries_[next].value;
    }
  }
  lower.finalize();
  entries_ = {};
  Eigen::SparseMatrix<double> whole = lower.selfadjointView<Eigen::Lower>();
  return whole;
}

}  // namespace trammel::solver
