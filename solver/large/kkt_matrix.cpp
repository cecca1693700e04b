#include "solver/large/kkt_matrix.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "solver/linalg/factorization.h"

namespace trammel::solver::large_motion {

struct KktMatrix::Factors {
  SparseLdlt ldlt{SparseLdlt::Triangle::upper, SparseLdlt::Ordering::natural};
  SparseLu<double> lu;
  bool use_lu = true;
};

KktMatrix::~KktMatrix() = default;

KktMatrix::KktMatrix(Index coordinates, Index constraints, const Blocks& blocks)
    : coordinates_(coordinates), constraints_(constraints), factors_(std::make_unique<Factors>()) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Index i = 0; i < coordinates + constraints; ++i) entries.emplace_back(i, i, 0.0);
  for (const std::vector<Index>& block : blocks) {
    for (const Index i : block) {
      for (const Index j : block)
        if (i >= 0 && j >= 0) entries.emplace_back(i, j, 0.0);
    }
  }
  matrix_.resize(coordinates + constraints, coordinates + constraints);
  matrix_.setFromTriplets(entries.begin(), entries.end());
  set_elimination_order(blocks);
  locate_entries(blocks);
  multiplier_scaling_ = VectorXd::Zero(constraints);
  work_.resize(coordinates + constraints);
  solution_.resize(coordinates + constraints);
}

void KktMatrix::set_elimination_order(const Blocks& blocks) {
  using Indices = Eigen::Matrix<Index, Eigen::Dynamic, 1>;
  const Index n = coordinates_, size = coordinates_ + constraints_;
  Eigen::PermutationMatrix<Eigen::Dynamic> elimination;
  if (n > 0) {
    const Eigen::SparseMatrix<double> pattern = matrix_.topLeftCorner(n, n);
    Eigen::AMDOrdering<int>()(pattern, elimination);
  }
  // Sort key of each unknown. The key of a coordinate is twice its position in the elimination
  // order. A constraint row follows directly after the last coordinate of the row.
  Indices key = Indices::Constant(size, -1);
  for (Index p = 0; p < n; ++p) key[elimination.indices()[p]] = 2 * p;
  for (const std::vector<Index>& block : blocks) {
    Index last = -1;
    for (const Index i : block) {
      if (i >= 0 && i < n) last = std::max(last, key[i]);
    }
    for (const Index i : block) {
      if (i < n) continue;
      assert(key[i] == -1 && "a row belongs to one block");
      key[i] = last + 1;
    }
  }
  Indices sequence = Indices::LinSpaced(size, 0, size - 1);
  std::stable_sort(sequence.begin(), sequence.end(),
                   [&](Index i, Index j) { return key[i] < key[j]; });
  permutation_.resize(size);
  for (Index p = 0; p < size; ++p) permutation_.indices()[sequence[p]] = static_cast<int>(p);
  Eigen::SparseMatrix<double> ordered;
  ordered = matrix_.twistedBy(permutation_);
  matrix_.swap(ordered);
}

void KktMatrix::locate_entries(const Blocks& blocks) {
  const auto& position = permutation_.indices();
  const auto value_index = [&](Index i, Index j) {
    return static_cast<int>(&matrix_.coeffRef(position[i], position[j]) - matrix_.valuePtr());
  };
  for (const std::vector<Index>& block : blocks) {
    block_start_.push_back(value_index_.size());
    first_row_.push_back(block.empty() ? 0 : block.back() - coordinates_ + 1);
    for (const Index j : block) {
      if (j >= coordinates_) --first_row_.back();
      for (const Index i : block) value_index_.push_back(i < 0 || j < 0 ? -1 : value_index(i, j));
    }
  }
  for (Index i = 0; i < coordinates_; ++i) diagonal_.push_back(value_index(i, i));
}

void KktMatrix::clear() {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  multiplier_scaling_.setZero();
}

void KktMatrix::add_diagonal(Index coordinate, double value) {
  matrix_.valuePtr()[diagonal_[static_cast<std::size_t>(coordinate)]] += value;
}

bool KktMatrix::factor(bool symmetric) {
  ++factorizations_;
  Factors& f = *factors_;
  f.use_lu = !(symmetric && f.ldlt.factorize(matrix_));
  return !f.use_lu || f.lu.factorize(matrix_);
}

void KktMatrix::solve(Eigen::Ref<VectorXd> right_hand_side) const {
  ++solves_;
  work_.noalias() = permutation_ * right_hand_side;
  if (factors_->use_lu) {
    solution_ = factors_->lu.solve(work_);
  } else {
    factors_->ldlt.solve(work_, solution_);
  }
  work_.noalias() = permutation_.transpose() * solution_;
  work_.tail(constraints_) += multiplier_scaling_.cwiseProduct(right_hand_side.tail(constraints_));
  right_hand_side = work_;
}

KktMatrix::Extended KktMatrix::multiply(const Extended& x) const {
  const Extended ordered = permutation_ * x;
  return permutation_.transpose() * Extended(matrix_.cast<long double>() * ordered);
}

Eigen::MatrixXd KktMatrix::constraint_gradient(const VectorXd& scale,
                                               const VectorXd& row_units) const {
  const Eigen::PermutationMatrix<Eigen::Dynamic> unknown(permutation_.inverse());
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(constraints_, coordinates_);
  for (Index k = 0; k < matrix_.cols(); ++k) {
    const Index column = unknown.indices()[k];
    if (column >= coordinates_) continue;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix_, k); entry; ++entry) {
      const Index row = unknown.indices()[entry.row()] - coordinates_;
      if (row >= 0) G(row, column) = entry.value() * scale[column] / row_units[row];
    }
  }
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
  work_.noalias() = permutation_ * x.cwiseAbs();
  solution_.noalias() = matrix_.cwiseAbs() * work_;
  magnitudes.noalias() = permutation_.transpose() * solution_;
}

Index KktMatrix::unstable_direction_count() const {
  return factors_->use_lu ? -1 : factors_->ldlt.negative_pivots() - constraints_;
}

}  // namespace trammel::solver::large_motion
