#include "solver/large_motion/elements/kkt_matrix.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/linalg/sparse_ldlt.h"
#include "solver/linalg/sparse_lu.h"

namespace trammel::solver::large_motion {

namespace {

using Blocks = std::vector<std::vector<Index>>;

Eigen::SparseMatrix<double> coordinate_pattern(Index n, const Blocks& blocks) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < n; ++i) entries.emplace_back(i, i, 1.0);
  for (const std::vector<Index>& block : blocks) {
    for (const Index i : block) {
      if (i < 0 || i >= n) continue;
      for (const Index j : block) {
        if (j >= 0 && j < n) entries.emplace_back(i, j, 1.0);
      }
    }
  }
  Eigen::SparseMatrix<double> pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  return pattern;
}

}  // namespace

struct KktMatrix::Factors {
  SparseLdlt ldlt{SparseLdlt::Triangle::upper, SparseLdlt::Ordering::natural};
  SparseLu<double> lu;
  bool factored = false, use_lu = false;
};

KktMatrix::~KktMatrix() = default;

KktMatrix::KktMatrix(Index coordinates, Index constraints, const Blocks& blocks)
    : coordinates_(coordinates), constraints_(constraints), factors_(std::make_unique<Factors>()) {
  order(blocks);
  allocate(blocks);
  multiplier_scaling_ = VectorXd::Zero(constraints);
  work_.resize(coordinates + constraints);
  solution_.resize(coordinates + constraints);
}

void KktMatrix::order(const Blocks& blocks) {
  const Index n = coordinates_, size = coordinates_ + constraints_;
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> elimination;
  if (n > 0) Eigen::AMDOrdering<int>()(coordinate_pattern(n, blocks), elimination);
  // Twice the position among the coordinates; a row comes right after its last coordinate.
  std::vector<Index> key(static_cast<std::size_t>(size), -1);
  for (Index p = 0; p < n; ++p) {
    key[static_cast<std::size_t>(elimination.indices()[p])] = 2 * p;
  }
  for (const std::vector<Index>& block : blocks) {
    Index last = -1;
    for (const Index i : block) {
      if (i >= 0 && i < n) last = std::max(last, key[static_cast<std::size_t>(i)]);
    }
    for (const Index i : block) {
      if (i < n) continue;
      assert(key[static_cast<std::size_t>(i)] == -1 && "a row belongs to one block");
      key[static_cast<std::size_t>(i)] = last + 1;
    }
  }
  std::vector<Index> sequence(static_cast<std::size_t>(size));
  std::iota(sequence.begin(), sequence.end(), Index{0});
  std::stable_sort(sequence.begin(), sequence.end(), [&](Index i, Index j) {
    return key[static_cast<std::size_t>(i)] < key[static_cast<std::size_t>(j)];
  });
  permutation_.resize(static_cast<std::size_t>(size));
  for (Index p = 0; p < size; ++p) {
    permutation_[static_cast<std::size_t>(sequence[static_cast<std::size_t>(p)])] = p;
  }
}

void KktMatrix::allocate(const Blocks& blocks) {
  const Index size = coordinates_ + constraints_;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < size; ++i) entries.emplace_back(i, i, 0.0);
  for (const std::vector<Index>& block : blocks) {
    for (const Index i : block) {
      if (i < 0) continue;
      for (const Index j : block) {
        if (j < 0) continue;
        entries.emplace_back(permutation_[static_cast<std::size_t>(i)],
                             permutation_[static_cast<std::size_t>(j)], 0.0);
      }
    }
  }
  matrix_.resize(size, size);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  matrix_.makeCompressed();
  for (const std::vector<Index>& block : blocks) {
    block_start_.push_back(value_index_.size());
    for (const Index j : block) {
      for (const Index i : block) value_index_.push_back(i < 0 || j < 0 ? -1 : value_index(i, j));
    }
  }
  for (Index i = 0; i < coordinates_; ++i) diagonal_.push_back(value_index(i, i));
  row_of_value_.assign(static_cast<std::size_t>(matrix_.nonZeros()), -1);
  for (Index r = 0; r < constraints_; ++r) {
    const int slot = value_index(coordinates_ + r, coordinates_ + r);
    row_of_value_[static_cast<std::size_t>(slot)] = r;
  }
}

int KktMatrix::value_index(Index row, Index column) const {
  const int i = static_cast<int>(permutation_[static_cast<std::size_t>(row)]);
  const Index j = permutation_[static_cast<std::size_t>(column)];
  const int* begin = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j];
  const int* end = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[j + 1];
  const int* found = std::lower_bound(begin, end, i);
  assert(found != end && *found == i);
  return static_cast<int>(found - matrix_.innerIndexPtr());
}

void KktMatrix::clear() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  multiplier_scaling_.setZero();
}

void KktMatrix::add_diagonal(Index coordinate, double value) {
  matrix_.valuePtr()[diagonal_[static_cast<std::size_t>(coordinate)]] += value;
}

void KktMatrix::add_row_diagonal(Index block, Index local, Index size, double value,
                                 double scaling) {
  const std::size_t start = block_start_[static_cast<std::size_t>(block)];
  const int slot = value_index_[start + static_cast<std::size_t>(local * size + local)];
  if (slot < 0) return;
  matrix_.valuePtr()[slot] += value;
  multiplier_scaling_[row_of_value_[static_cast<std::size_t>(slot)]] = scaling;
}

bool KktMatrix::factor(bool symmetric) {
  ++factorizations_;
  Factors& f = *factors_;
  f.use_lu = !symmetric;
  if (f.use_lu) return f.lu.factorize(matrix_);
  f.factored = true;
  if (f.ldlt.factorize(matrix_)) return true;
  f.use_lu = true;
  return f.lu.factorize(matrix_);
}

void KktMatrix::solve(Eigen::Ref<VectorXd> right_hand_side) const {
  ++solves_;
  const Index size = coordinates_ + constraints_;
  for (Index i = 0; i < size; ++i)
    work_[permutation_[static_cast<std::size_t>(i)]] = right_hand_side[i];
  if (factors_->use_lu) {
    solution_ = factors_->lu.solve(work_);
  } else {
    factors_->ldlt.solve(work_, solution_);
  }
  for (Index i = 0; i < coordinates_; ++i) {
    right_hand_side[i] = solution_[permutation_[static_cast<std::size_t>(i)]];
  }
  for (Index r = 0; r < constraints_; ++r) {
    double& y = right_hand_side[coordinates_ + r];
    y = solution_[permutation_[static_cast<std::size_t>(coordinates_ + r)]] +
        multiplier_scaling_[r] * y;
  }
}

KktMatrix::Extended KktMatrix::multiply(const Extended& x) const {
  Extended ordered(x.size()), sums = Extended::Zero(x.size()), product(x.size());
  for (Index i = 0; i < x.size(); ++i) ordered[permutation_[static_cast<std::size_t>(i)]] = x[i];
  for (Index column = 0; column < matrix_.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it)
      sums[it.row()] += static_cast<long double>(it.value()) * ordered[column];
  }
  for (Index i = 0; i < x.size(); ++i) product[i] = sums[permutation_[static_cast<std::size_t>(i)]];
  return product;
}

Eigen::SparseMatrix<double> KktMatrix::constraint_gradient(const VectorXd& scale,
                                                           const VectorXd& row_unit) const {
  std::vector<Index> unknown(permutation_.size());
  for (std::size_t i = 0; i < permutation_.size(); ++i)
    unknown[static_cast<std::size_t>(permutation_[i])] = static_cast<Index>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (Index column = 0; column < matrix_.cols(); ++column) {
    const Index k = unknown[static_cast<std::size_t>(column)];
    if (k >= coordinates_) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it) {
      const Index r = unknown[static_cast<std::size_t>(it.row())] - coordinates_;
      if (r >= 0) entries.emplace_back(r, k, it.value() * scale[k] / row_unit[r]);
    }
  }
  Eigen::SparseMatrix<double> G(constraints_, coordinates_);
  G.setFromTriplets(entries.begin(), entries.end());
  return G;
}

double KktMatrix::energy_over_roundoff(const Extended& x) const {
  const VectorXd size = x.cast<double>().cwiseAbs();
  VectorXd terms(x.size());
  term_magnitudes(size, terms);
  const double roundoff =
      16 * std::numeric_limits<double>::epsilon() * size.cwiseProduct(terms).norm();
  const auto energy = static_cast<double>(x.dot(multiply(x)));
  return roundoff > 0 ? std::abs(energy) / roundoff : 0;
}

void KktMatrix::term_magnitudes(const VectorXd& x, VectorXd& magnitudes) const {
  solution_.setZero();
  for (Index i = 0; i < x.size(); ++i)
    work_[permutation_[static_cast<std::size_t>(i)]] = std::abs(x[i]);
  for (Index column = 0; column < matrix_.cols(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix_, column); it; ++it)
      solution_[it.row()] += std::abs(it.value()) * work_[column];
  }
  for (Index i = 0; i < x.size(); ++i)
    magnitudes[i] = solution_[permutation_[static_cast<std::size_t>(i)]];
}

Index KktMatrix::negative_pivots() const {
  if (factors_->use_lu || !factors_->factored) return -1;
  return factors_->ldlt.negative_pivots() - constraints_;
}

}  // namespace trammel::solver::large_motion
