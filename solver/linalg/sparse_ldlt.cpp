#include "solver/linalg/sparse_ldlt.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <iostream>  // MetisSupport needs it
#include <mutex>
#include <numeric>
#include <optional>
#include <vector>

#include "solver/linalg/supernodal_ldlt.h"

// after <iostream>
#include <Eigen/MetisSupport>

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

constexpr Index kLarge = 5000;  // coordinates: METIS and dense fronts pay

/// The upper triangle of P A P^T, whose values are the places of its entries among those of one
/// triangle of A.
template <unsigned Triangle>
SparseMatrix permuted_places(const SparseMatrix& A, const Permutation& P) {
  SparseMatrix places = A;
  std::iota(places.valuePtr(), places.valuePtr() + places.nonZeros(), 0.0);
  SparseMatrix upper(A.rows(), A.cols());
  upper.selfadjointView<Eigen::Upper>() = places.selfadjointView<Triangle>().twistedBy(P);
  return upper;
}

/// The same matrix, each column by rising rows.
SparseMatrix sorted(const SparseMatrix& A) {
  const SparseMatrix rows = A.transpose();
  return rows.transpose();
}

std::vector<Index> values_of(const SparseMatrix& places) {
  return {places.valuePtr(), places.valuePtr() + places.nonZeros()};
}

}  // namespace

Permutation fill_reducing_order(const SparseMatrix& A) {
  Permutation elimination;  // its entry k is the coordinate eliminated k-th
  if (A.rows() == 0) return elimination;
  if (A.rows() < kLarge) {
    Eigen::AMDOrdering<int>()(A, elimination);
  } else {
    // METIS seeds and draws from the one random sequence of the process.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    Eigen::MetisOrdering<int>()(A, elimination);
  }
  return elimination.inverse();
}

struct SparseLdlt::Factors {
  Ordering ordering;
  Triangle triangle;
  std::vector<int> columns, rows;   // pattern that the order is of
  Permutation P;                    // coordinate -> its place in the order of elimination
  SparseMatrix upper;               // upper triangle in that order
  std::vector<Index> from, mirror;  // entry of upper -> that of A, and the one across its diagonal
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt;
  std::optional<SupernodalLdlt> supernodal;  // in place of ldlt
  VectorXd D;
  mutable VectorXd ordered;

  [[nodiscard]] bool has_pattern_of(const SparseMatrix& A) const {
    return columns.size() == to_size(A.cols()) + 1 &&
           std::equal(columns.begin(), columns.end(), A.outerIndexPtr()) &&
           std::equal(rows.begin(), rows.end(), A.innerIndexPtr());
  }

  void analyze(const SparseMatrix& A) {
    columns.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    rows.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    supernodal.reset();
    if (ordering == Ordering::fill_reducing) {
      P = fill_reducing_order(A);
      if (A.rows() >= kLarge) supernodal.emplace();
    } else {
      P.setIdentity(A.rows());
    }
    if (supernodal) {
      const std::vector<Index> place =
          postorder(elimination_tree(permuted_places<Eigen::Lower>(A, P)));
      for (int& i : P.indices()) i = static_cast<int>(place[to_size(i)]);
    }
    if (triangle == Triangle::mean) {  // sorted, so that the two agree entry by entry
      upper = sorted(permuted_places<Eigen::Lower>(A, P));
      mirror = values_of(sorted(permuted_places<Eigen::Upper>(A, P)));
    } else {
      upper = triangle == Triangle::lower ? permuted_places<Eigen::Lower>(A, P)
                                          : permuted_places<Eigen::Upper>(A, P);
    }
    from = values_of(upper);
    supernodal ? supernodal->analyze(upper) : ldlt.analyzePattern(upper);
    ordered.resize(A.rows());
  }

  [[nodiscard]] bool factorize() {
    if (supernodal) {
      if (!supernodal->factorize(upper)) return false;
      D = supernodal->pivots();
      return true;
    }
    ldlt.factorize(upper);
    D = ldlt.vectorD();
    return ldlt.info() == Eigen::Success && D.allFinite();
  }
  [[nodiscard]] SparseMatrix L() const {
    return supernodal ? supernodal->L() : SparseMatrix(ldlt.matrixL());
  }
  void solve_lower(VectorXd& x) const {
    if (supernodal) return supernodal->solve_lower(x);
    const auto& L = ldlt.matrixL().nestedExpression();
    const int *start = L.outerIndexPtr(), *row = L.innerIndexPtr();
    for (Index j = 0; j < x.size(); ++j) {
      const double own = x[j];
      for (int k = start[j]; k < start[j + 1]; ++k) x[row[k]] -= L.valuePtr()[k] * own;
    }
  }
  void solve_lower_transposed(VectorXd& x) const {
    if (supernodal) return supernodal->solve_lower_transposed(x);
    const auto& L = ldlt.matrixL().nestedExpression();
    const int *start = L.outerIndexPtr(), *row = L.innerIndexPtr();
    for (Index j = x.size() - 1; j >= 0; --j) {
      double own = x[j];
      for (int k = start[j]; k < start[j + 1]; ++k) own -= L.valuePtr()[k] * x[row[k]];
      x[j] = own;
    }
  }
};

SparseLdlt::SparseLdlt(Triangle triangle, Ordering ordering)
    : factors_(std::make_unique<Factors>()) {
  factors_->ordering = ordering;
  factors_->triangle = triangle;
}
SparseLdlt::~SparseLdlt() = default;
SparseLdlt::SparseLdlt(SparseLdlt&&) noexcept = default;
SparseLdlt& SparseLdlt::operator=(SparseLdlt&&) noexcept = default;

bool SparseLdlt::factorize(const SparseMatrix& A) {
  Factors& f = *factors_;
  if (!f.has_pattern_of(A)) f.analyze(A);
  double* const values = f.upper.valuePtr();
  for (std::size_t k = 0; k < f.from.size(); ++k) values[k] = A.valuePtr()[f.from[k]];
  for (std::size_t k = 0; k < f.mirror.size(); ++k) {
    values[k] = (values[k] + A.valuePtr()[f.mirror[k]]) / 2;
  }
  return f.factorize();
}

const VectorXd& SparseLdlt::pivots() const {
  return factors_->D;
}

Index SparseLdlt::negative_pivots() const {
  return (factors_->D.array() < 0).count();
}

double SparseLdlt::smallest_to_largest_pivot() const {
  const VectorXd& D = factors_->D;
  double smallest = 1;
  for (Index j = 0; j < D.size(); ++j) {
    for (SparseMatrix::InnerIterator it(factors_->upper, j); it; ++it) {
      if (it.row() != j) continue;
      smallest = std::min(smallest, it.value() == 0 ? 0 : std::abs(D[j] / it.value()));
    }
  }
  return smallest;
}

double SparseLdlt::element_growth() const {
  if (factors_->supernodal) return factors_->supernodal->largest_entry();
  const auto& L = factors_->ldlt.matrixL().nestedExpression();
  return L.nonZeros() > 0 ? L.coeffs().abs().maxCoeff() : 0;
}

void SparseLdlt::solve(const VectorXd& b, VectorXd& x) const {
  const Eigen::VectorXi& place = factors_->P.indices();
  VectorXd& y = factors_->ordered;
  for (Index i = 0; i < b.size(); ++i) y[place[i]] = b[i];
  factors_->solve_lower(y);
  y = factors_->D.cwiseInverse().cwiseProduct(y);
  factors_->solve_lower_transposed(y);
  x.resize(b.size());
  for (Index i = 0; i < b.size(); ++i) x[i] = y[place[i]];
}

VectorXd SparseLdlt::solve_half(const VectorXd& b) const {
  VectorXd y = factors_->P * b;
  factors_->solve_lower(y);
  return y.cwiseQuotient(factors_->D.cwiseSqrt());
}

VectorXd SparseLdlt::solve_half_transposed(const VectorXd& y) const {
  VectorXd x = y.cwiseQuotient(factors_->D.cwiseSqrt());
  factors_->solve_lower_transposed(x);
  return factors_->P.transpose() * x;
}

SparseMatrix SparseLdlt::square_root() const {
  const VectorXd root = factors_->D.cwiseMax(0).cwiseSqrt();
  const SparseMatrix U = root.asDiagonal() * SparseMatrix(factors_->L().transpose());
  return U * factors_->P;
}

Index negative_pivots(const Eigen::SparseMatrix<std::complex<double>>& H) {
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<std::complex<double>>> ldlt(H);
  if (ldlt.info() != Eigen::Success) return -1;
  return (ldlt.vectorD().real().array() < 0).count();
}

}  // namespace trammel::solver
