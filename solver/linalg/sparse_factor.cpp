#include "solver/linalg/sparse_factor.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace trammel::solver {
namespace {

/// Position of entry (row, column) among the values of a compressed matrix.
Index entry(const SparseMatrix& A, Index row, Index column) {
  const int* const begin = A.innerIndexPtr() + A.outerIndexPtr()[column];
  const int* const end = A.innerIndexPtr() + A.outerIndexPtr()[column + 1];
  const int* const found = std::lower_bound(begin, end, static_cast<int>(row));
  assert(found != end && *found == row && "the pattern is structurally symmetric");
  return found - A.innerIndexPtr();
}

}  // namespace

SparseFactor::SparseFactor(const SparseMatrix& pattern) {
  const Index n = pattern.rows();
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Upper>(), order);
  // AMDOrdering gives the inverse permutation: its entry k is the coordinate eliminated k-th.
  permutation_.resize(static_cast<std::size_t>(n));
  for (Index k = 0; k < n; ++k) {
    permutation_[static_cast<std::size_t>(order.indices()[k])] = static_cast<int>(k);
  }
  std::vector<Eigen::Triplet<double>> triplets;
  for (Index column = 0; column < n; ++column) {
    for (SparseMatrix::InnerIterator it(pattern, column); it; ++it) {
      const int i = permutation_[static_cast<std::size_t>(it.row())];
      const int j = permutation_[static_cast<std::size_t>(column)];
      if (i <= j) triplets.emplace_back(i, j, 1.0);
    }
  }
  upper_.resize(n, n);
  upper_.setFromTriplets(triplets.begin(), triplets.end());
  from_.reserve(triplets.size());
  mirror_.reserve(triplets.size());
  for (Index j = 0; j < n; ++j) {
    const Index column = order.indices()[j];
    for (SparseMatrix::InnerIterator it(upper_, j); it; ++it) {
      const Index row = order.indices()[it.row()];
      from_.push_back(entry(pattern, row, column));
      mirror_.push_back(entry(pattern, column, row));
    }
  }
  ldlt_.analyzePattern(upper_);
  ordered_.resize(n);
  solved_.resize(n);
}

bool SparseFactor::factorize(const SparseMatrix& A) {
  double* const values = upper_.valuePtr();
  for (std::size_t k = 0; k < from_.size(); ++k) {
    values[k] = (A.valuePtr()[from_[k]] + A.valuePtr()[mirror_[k]]) / 2;
  }
  ldlt_.factorize(upper_);
  return ldlt_.info() == Eigen::Success && ldlt_.vectorD().allFinite();
}

double SparseFactor::pivot_ratio() const {
  const Eigen::VectorXd D = ldlt_.vectorD();
  double smallest = 1;
  for (Index j = 0; j < D.size(); ++j) {
    const double diagonal = upper_.coeff(j, j);
    smallest = std::min(smallest, diagonal == 0 ? 0 : std::abs(D[j] / diagonal));
  }
  return smallest;
}

void SparseFactor::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x) {
  for (Index i = 0; i < b.size(); ++i) ordered_[permutation_[static_cast<std::size_t>(i)]] = b[i];
  solved_ = ldlt_.solve(ordered_);
  x.resize(b.size());
  for (Index i = 0; i < b.size(); ++i) x[i] = solved_[permutation_[static_cast<std::size_t>(i)]];
}

}  // namespace trammel::solver
