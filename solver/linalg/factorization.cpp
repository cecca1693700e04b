#include "solver/linalg/factorization.h"

#include <unsupported/Eigen/src/IterativeSolvers/Scaling.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <iostream>  // required by MetisSupport
#include <limits>
#include <mutex>
#include <numeric>
#include <unsupported/Eigen/IterativeSolvers>
#include <vector>

// MetisSupport uses declarations of <iostream> without including it.
#include <Eigen/MetisSupport>

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

/// Returns a matrix with the sparsity pattern of the upper triangle of P A P^T. The value of each
/// entry is the index of the corresponding entry in the value array of A. Only the given triangle
/// of A is used.
template <unsigned Triangle>
SparseMatrix permuted_value_indices(const SparseMatrix& A, const Permutation& P) {
  SparseMatrix places = A;
  std::iota(places.valuePtr(), places.valuePtr() + places.nonZeros(), 0.0);
  SparseMatrix upper(A.rows(), A.cols());
  upper.selfadjointView<Eigen::Upper>() = places.selfadjointView<Triangle>().twistedBy(P);
  return upper;
}

/// Returns A with the entries of each column stored in the order of their rows.
SparseMatrix sorted(const SparseMatrix& A) {
  const SparseMatrix rows = A.transpose();
  return rows.transpose();
}

/// Replaces x by L^-T x. The unit diagonal of L is not stored. Both loops run from the last entry
/// to the first, because the processor prefetches memory in one direction only.
void solve_transposed(const SparseMatrix& L, VectorXd& x) {
  const int *start = L.outerIndexPtr(), *row = L.innerIndexPtr();
  const double* value = L.valuePtr();
  for (Index j = L.cols() - 1; j >= 0; --j) {
    double sum = 0;
    for (int k = start[j + 1] - 1; k >= start[j]; --k) sum += value[k] * x[row[k]];
    x[j] -= sum;
  }
}

std::vector<Index> values_of(const SparseMatrix& places) {
  return {places.valuePtr(), places.valuePtr() + places.nonZeros()};
}

}  // namespace

Permutation fill_reducing_order(const SparseMatrix& A) {
  constexpr Index kSmall = 5000;
  Permutation elimination;  // index k: number of the coordinate that is eliminated k-th
  if (A.rows() == 0) return elimination;
  if (A.rows() < kSmall) {
    Eigen::AMDOrdering<int>()(A, elimination);
  } else {
    // Only one thread at a time may call METIS, because METIS uses the global random sequence of
    // the process.
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    Eigen::MetisOrdering<int>()(A, elimination);
  }
  return elimination.inverse();
}

struct SparseLdlt::Factors {
  Ordering ordering;
  Triangle triangle;
  std::vector<int> columns, rows;  // sparsity pattern for which P was computed
  Permutation P;                   // coordinate -> its position in the order of elimination
  SparseMatrix upper;              // upper triangle of P A P^T
  // Indices in the value array of A for each entry of `upper`: of the entry itself (`from`), and of
  // the transposed entry (`mirror`).
  std::vector<Index> from, mirror;
  Eigen::SimplicialLDLT<SparseMatrix, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt;
  VectorXd pivots, root;  // diagonal of D, and |D|^(1/2) for `apply_inverse_factor`
  mutable VectorXd ordered, solved;

  [[nodiscard]] bool has_pattern_of(const SparseMatrix& A) const {
    return columns.size() == to_size(A.cols()) + 1 &&
           std::equal(columns.begin(), columns.end(), A.outerIndexPtr()) &&
           std::equal(rows.begin(), rows.end(), A.innerIndexPtr());
  }

  void analyze(const SparseMatrix& A) {
    columns.assign(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1);
    rows.assign(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros());
    if (ordering == Ordering::fill_reducing) {
      P = fill_reducing_order(A);
    } else {
      P.setIdentity(A.rows());
    }
    if (triangle == Triangle::mean) {  // sorted, so that both triangles agree entry by entry
      upper = sorted(permuted_value_indices<Eigen::Lower>(A, P));
      mirror = values_of(sorted(permuted_value_indices<Eigen::Upper>(A, P)));
    } else {
      upper = triangle == Triangle::lower ? permuted_value_indices<Eigen::Lower>(A, P)
                                          : permuted_value_indices<Eigen::Upper>(A, P);
    }
    from = values_of(upper);
    ldlt.analyzePattern(upper);
    ordered.resize(A.rows());
    solved.resize(A.rows());
  }
};

SparseLdlt::SparseLdlt(Triangle triangle, Ordering ordering)
    : factors_(new Factors, [](Factors* factors) { delete factors; }) {
  factors_->ordering = ordering;
  factors_->triangle = triangle;
}

bool SparseLdlt::factorize(const SparseMatrix& A) {
  Factors& f = *factors_;
  bool same = f.has_pattern_of(A);
  if (!same) f.analyze(A);
  double* const values = f.upper.valuePtr();
  for (std::size_t k = 0; k < f.from.size(); ++k) {
    double value = A.valuePtr()[f.from[k]];
    if (!f.mirror.empty()) value = (value + A.valuePtr()[f.mirror[k]]) / 2;
    same = same && values[k] == value;
    values[k] = value;
  }
  if (!same) {
    f.ldlt.factorize(f.upper);
    f.pivots = f.ldlt.vectorD();
    f.root = f.pivots.cwiseAbs().cwiseSqrt();
  }
  return f.ldlt.info() == Eigen::Success && f.pivots.allFinite();
}

const VectorXd& SparseLdlt::pivots() const {
  return factors_->pivots;
}

Index SparseLdlt::negative_pivots() const {
  return (factors_->pivots.array() < 0).count();
}

double SparseLdlt::smallest_pivot_to_diagonal() const {
  const VectorXd& D = pivots();
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
  const auto& L = factors_->ldlt.matrixL().nestedExpression();
  return L.nonZeros() > 0 ? L.coeffs().abs().maxCoeff() : 0;
}

void SparseLdlt::solve(const VectorXd& b, VectorXd& x) const {
  const Eigen::VectorXi& place = factors_->P.indices();
  for (Index i = 0; i < b.size(); ++i) factors_->ordered[place[i]] = b[i];
  factors_->solved = factors_->ordered;
  factors_->ldlt.matrixL().solveInPlace(factors_->solved);
  factors_->solved.array() /= factors_->pivots.array();
  solve_transposed(factors_->ldlt.matrixL().nestedExpression(), factors_->solved);
  x.resize(b.size());
  for (Index i = 0; i < b.size(); ++i) x[i] = factors_->solved[place[i]];
}

VectorXd SparseLdlt::apply_inverse_factor(const VectorXd& b) const {
  VectorXd y = factors_->P * b;
  factors_->ldlt.matrixL().solveInPlace(y);
  y.array() /= factors_->root.array();
  return y;
}

VectorXd SparseLdlt::apply_inverse_factor_transposed(const VectorXd& y) const {
  VectorXd x = y.cwiseQuotient(factors_->root);
  solve_transposed(factors_->ldlt.matrixL().nestedExpression(), x);
  return factors_->P.transpose() * x;
}

void Factorization::compute(const SparseMatrix& A) {
  scaling_ =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
  SparseMatrix scaled = A;
  for (Index j = 0; j < A.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(scaled, j); it; ++it)
      it.valueRef() *= scaling_[it.row()] * scaling_[j];
  }
  exists_ = ldlt_.factorize(scaled);
}

std::optional<Index> Factorization::sturm_count(const SparseMatrix& A) {
  compute(A);
  return is_reliable() ? std::optional(negative_pivots()) : std::nullopt;
}

double Factorization::smallest_pivot() const {
  const VectorXd& D = ldlt_.pivots();
  return D.size() == 0 ? 1.0 : D.minCoeff();
}

VectorXd Factorization::solve(const VectorXd& b) const {
  VectorXd x;
  ldlt_.solve(scaling_.cwiseProduct(b), x);
  return scaling_.cwiseProduct(x);
}

VectorXd Factorization::apply_inverse_factor(const VectorXd& b) const {
  return ldlt_.apply_inverse_factor(scaling_.cwiseProduct(b));
}

VectorXd Factorization::apply_inverse_factor_transposed(const VectorXd& y) const {
  return scaling_.cwiseProduct(ldlt_.apply_inverse_factor_transposed(y));
}

template <class Scalar>
struct SparseLu<Scalar>::Factors {
  Eigen::SparseLU<Eigen::SparseMatrix<Scalar>, Eigen::COLAMDOrdering<int>> lu;
  Eigen::IterScaling<Eigen::SparseMatrix<Scalar>> scaling;
  bool analyzed = false;
};

template <class Scalar>
SparseLu<Scalar>::SparseLu() : factors_(new Factors, [](Factors* factors) { delete factors; }) {}

template <class Scalar>
bool SparseLu<Scalar>::factorize(const Eigen::SparseMatrix<Scalar>& A) {
  if (A.rows() == 0) return true;
  // Without scaling, the units of length and force would decide which rows are exchanged.
  Eigen::SparseMatrix<Scalar> scaled = A;
  factors_->scaling.computeRef(scaled);
  if (!Eigen::Map<const Vector>(scaled.valuePtr(), scaled.nonZeros()).allFinite()) return false;
  if (!factors_->analyzed) factors_->lu.analyzePattern(scaled);
  factors_->analyzed = true;
  factors_->lu.factorize(scaled);
  return factors_->lu.info() == Eigen::Success;
}

template <class Scalar>
typename SparseLu<Scalar>::Vector SparseLu<Scalar>::solve(const Vector& b) const {
  if (b.size() == 0) return b;
  const Vector y = factors_->lu.solve(Vector(factors_->scaling.LeftScaling().cwiseProduct(b)));
  return factors_->scaling.RightScaling().cwiseProduct(y);
}

template class SparseLu<double>;
template class SparseLu<std::complex<double>>;

RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, Counters& counters) {
  const Eigen::VectorXd x = factorization.solve(b);
  ++counters.solves;
  return refined_solve(A, factorization, b, x, counters);
}

RefinedSolution refined_solve(const Operator& A, const Factorization& factorization,
                              const Eigen::VectorXd& b, const Eigen::VectorXd& guess,
                              Counters& counters) {
  constexpr int kMaxSteps = 8;
  constexpr double kSmall = 1e-10;  // relative size of a correction with negligible error
  RefinedSolution result{guess, 0};
  double last = std::numeric_limits<double>::infinity();  // size of the previous correction
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::VectorXd correction = factorization.solve(b - A(result.x));
    ++counters.solves;
    // Divide by the scaling of the matrix, so that meters and radians are comparable.
    const double size = correction.cwiseQuotient(factorization.scaling()).norm();
    const double whole = result.x.cwiseQuotient(factorization.scaling()).norm();
    result.correction = size == 0 ? 0 : size / whole;
    if (!(size < last)) break;  // no further convergence: round-off or a failed solution remains
    result.x += correction;
    if (size <= kSmall * whole || size > 0.5 * last) break;
    last = size;
  }
  return result;
}

}  // namespace trammel::solver
