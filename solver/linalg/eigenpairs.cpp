#include "solver/linalg/eigenpairs.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/lanczos.h"
#include "solver/model/numbers.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kIllConditioned =
    "the stiffness matrix is too ill-conditioned for double precision";
constexpr Index kDenseSize = 64;  // free coordinates; above, Lanczos is faster for a few modes
constexpr double kConvergenceTolerance =
    1e-11;                            // relative change of an eigenvalue in one inverse iteration
constexpr double kClusterGap = 1e-3;  // between neighbours that are certainly not copies

// K and B are symmetric: times a vector they stand as transposed, for rows add up in registers.

/// y -> F^-1 B F^-T y with F F^T = K - s B, in the complement of the columns of `known`.
class LanczosOperator {
 public:
  LanczosOperator(const SparseMatrix& B, const Factorization& factorization, const MatrixXd& known,
                  Counters& counters)
      : B_(B), factorization_(factorization), known_(known), counters_(counters) {}

  [[nodiscard]] VectorXd apply(const Eigen::Ref<const VectorXd>& x) const {
    const VectorXd p = factorization_.solve_half_transposed(complement(x));
    ++counters_.solves;
    return complement(factorization_.solve_half(B_.transpose() * p));
  }
  [[nodiscard]] VectorXd complement(VectorXd x) const {
    if (known_.cols() > 0) x.noalias() -= known_ * (known_.transpose() * x);
    return x;
  }

 private:
  const SparseMatrix& B_;
  const Factorization& factorization_;
  const MatrixXd& known_;
  Counters& counters_;
};

/// Provides the eigenvectors of the largest mu, dense or by Lanczos; more can be asked for, again
/// and again.
class EigenpairProvider {
 public:
  EigenpairProvider(const Pencil& pencil, bool dense, Counters& counters)
      : pencil_(pencil), dense_(dense), counters_(counters) {}

  /// Vectors of the `count` largest mu > 0 beyond the null vectors, or of all there are; fewer
  /// where Lanczos gave up.
  MatrixXd first_block(const Factorization& factorization, Index count, const MatrixXd& null) {
    if (!dense_) return lanczos(factorization, count, null);
    all_ = dense_vectors();
    taken_ = std::min(null.cols(), all_.cols());  // their mu is the largest
    return take_dense(count);
  }

  /// About `count` more in the complement of X, whose columns are orthogonal in K - s B.
  MatrixXd next_block(const Factorization& factorization, Index count, const MatrixXd& X) {
    return dense_ ? take_dense(count) : lanczos(factorization, count, X);
  }

  /// Whether there are no more than what is given; Lanczos may have given up.
  [[nodiscard]] bool gives_all() const { return dense_; }
  /// Whether the dense eigenvalue iteration failed.
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  [[nodiscard]] Index size() const { return pencil_.K->rows(); }

  MatrixXd take_dense(Index count) {
    const Index kept = std::min(count, all_.cols() - taken_);
    taken_ += kept;
    return all_.middleCols(taken_ - kept, kept);
  }

  /// All with mu > 0, the largest first.
  [[nodiscard]] MatrixXd dense_vectors() {
    const MatrixXd A = MatrixXd(*pencil_.K) - pencil_.shift * MatrixXd(*pencil_.B);
    const VectorXd scale = A.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
    const MatrixXd scaled_A = scale.asDiagonal() * A * scale.asDiagonal();
    const MatrixXd scaled_B = scale.asDiagonal() * MatrixXd(*pencil_.B) * scale.asDiagonal();
    const SymmetricEigenpairs<MatrixXd> pairs = symmetric_eigenpairs(scaled_B, scaled_A);
    failed_ = !pairs.converged;
    if (failed_) return MatrixXd(size(), 0);
    const VectorXd& mu = pairs.value;
    const double zero = static_cast<double>(size()) * kEps * mu.cwiseAbs().maxCoeff();
    const Index kept = (mu.array() > zero).count();
    return scale.asDiagonal() * pairs.vector.rightCols(kept).rowwise().reverse();
  }

  MatrixXd lanczos(const Factorization& factorization, Index count, const MatrixXd& X) {
    const Index dimension = size() - X.cols();
    const Index wanted = std::min(count, dimension - 1);
    if (wanted < 1 || pencil_.B->norm() == 0) return MatrixXd(size(), 0);
    MatrixXd known(size(), X.cols());  // in Lanczos' coordinates y = F^T x, where they are F^-1 A x
    for (Index j = 0; j < X.cols(); ++j) {
      known.col(j) =
          factorization.solve_half(*pencil_.K * X.col(j) - pencil_.shift * (*pencil_.B * X.col(j)));
      for (int pass = 0; pass < 2; ++pass) {
        known.col(j) -= known.leftCols(j) * (known.leftCols(j).transpose() * known.col(j));
      }
      known.col(j).normalize();
    }
    const LanczosOperator op(*pencil_.B, factorization, known, counters_);
    const Index subspace = std::min(dimension, std::max(2 * wanted + 1, wanted + 20));
    const auto [mu, Y] = largest_eigenpairs([&op](const auto& x) { return op.apply(x); },
                                            op.complement(start_vectors(size(), 1, X.cols())),
                                            {.wanted = wanted, .subspace = subspace});
    const double zero = 1e3 * kEps * (mu.size() > 0 ? std::abs(mu[0]) : 0.0);
    MatrixXd found(size(), 0);
    for (Index j = 0; j < mu.size(); ++j) {
      if (!(mu[j] > zero)) continue;
      found.conservativeResize(Eigen::NoChange, found.cols() + 1);
      found.rightCols<1>() = factorization.solve_half_transposed(op.complement(Y.col(j)));
    }
    return found;
  }

  const Pencil& pencil_;
  bool dense_, failed_ = false;
  Counters& counters_;
  MatrixXd all_;     // dense: every vector
  Index taken_ = 0;  // dense: how many have been handed out
};

class Solver {
 public:
  Solver(const Pencil& pencil, const MatrixXd& null, Index count, EigenMethod method,
         Factorization& factorization, Counters& counters)
      : pencil_(pencil),
        null_(null),
        count_(count),
        counters_(counters),
        provider_(pencil,
                  method == EigenMethod::dense ||
                      (method == EigenMethod::automatic && pencil.K->rows() <= kDenseSize) ||
                      pencil.K->rows() < 4,
                  counters),
        factorization_(factorization) {}

  Eigenpairs run() {
    constexpr int kRounds = 40, kUncertainRounds = 8;
    if (!factorization_.exists() || factorization_.smallest_pivot() <= 0) return no_eigenpairs();
    const Index guard = 3 + count_ / 4;
    add(provider_.first_block(factorization_, count_ + guard, null_));
    if (provider_.failed()) return no_eigenpairs();
    for (int round = 0; round < kRounds; ++round) {
      iterate_to_convergence();
      if (inverse_iteration_failed_) return no_eigenpairs();
      const Index expected = sturm_check();
      if (clear_of_rounding_) {
        if (expected == checked_) break;
        if (expected < checked_ || round + 1 == kRounds) return report_missing_eigenpairs(expected);
      } else if (round + 1 >= kUncertainRounds) {
        return no_eigenpairs();
      }
      factor();
      const Index before = X_.cols(), missing = std::max<Index>(0, expected - checked_);
      add(provider_.next_block(factorization_, missing + 2, with_null()));
      if (X_.cols() > before) continue;
      if (expected != checked_) return report_missing_eigenpairs(expected);
      if (!provider_.gives_all()) return no_eigenpairs();
      break;
    }
    if (some_are_hidden()) return report_hidden_eigenpairs();
    iterate_beside_each();
    finish();
    return pairs_;
  }

 private:
  void factor() {
    factorization_.compute(shifted(*pencil_.K, *pencil_.B, pencil_.shift));
    ++counters_.factorizations;
  }

  [[nodiscard]] VectorXd apply(const VectorXd& x) const {
    VectorXd y = pencil_.K_times(x);
    if (pencil_.shift != 0) y -= pencil_.shift * (pencil_.B->transpose() * x);
    return y;
  }

  /// B-orthogonal to the null vectors.
  void remove_null(Eigen::Ref<VectorXd> x) const {
    if (null_.cols() > 0) x -= null_ * (null_.transpose() * (*pencil_.B * x));
  }

  [[nodiscard]] MatrixXd with_null() const {
    MatrixXd all(X_.rows(), null_.cols() + X_.cols());
    all.leftCols(null_.cols()) = null_;
    all.rightCols(X_.cols()) = X_;
    return all;
  }

  void add(const MatrixXd& found) {
    const Index old = X_.cols();
    X_.conservativeResize(pencil_.K->rows(), old + found.cols());
    X_.rightCols(found.cols()) = found;
    for (Index j = old; j < X_.cols(); ++j) remove_null(X_.col(j));
  }

  /// More inverse iterations of the wanted vectors that need them, with K - t B factored next to
  /// their own values. (K - s B)^-1 B has the rounding of its largest |mu|, and leaves more of that
  /// vector in one of a smaller mu, by the ratio of both; here its own is the largest. Negative mu
  /// are not known.
  void iterate_beside_each() {
    constexpr double kAside = 1e-4, kWideSpread = 1e4;
    constexpr int kPasses = 4;
    constexpr double kEnough = 1e-9;  // a pass divides what other vectors leave by 1 / kAside
    const Index wanted = std::min(count_, X_.cols());
    if (wanted == 0) return;
    bool moved = false;
    const double first = null_.cols() > 0 ? 0 : pairs_.value[0];
    for (Index j = 0; j < wanted; ++j) {
      const double spread = (pairs_.value[j] - pencil_.shift) / (first - pencil_.shift);
      if (!pencil_.indefinite && !(spread > kWideSpread)) continue;
      const double t = pairs_.value[j] * (1 - kAside);
      factorization_.compute(shifted(*pencil_.K, *pencil_.B, t));
      ++counters_.factorizations;
      if (!factorization_.is_reliable()) continue;
      const Operator beside = [&](const VectorXd& x) -> VectorXd {
        return pencil_.K_times(x) - t * (pencil_.B->transpose() * x);
      };
      for (int pass = 0; pass < kPasses; ++pass) {
        const VectorXd guess = X_.col(j) / (pairs_.value[j] - t);
        const RefinedSolution y = refined_solve(
            beside, factorization_, pencil_.B->transpose() * X_.col(j), guess, counters_);
        if (!(y.correction < 0.1)) break;
        const VectorXd change = (y.x - guess).cwiseQuotient(factorization_.scaling());
        const double size = y.x.cwiseQuotient(factorization_.scaling()).norm();
        X_.col(j) = y.x * (X_.col(j).norm() / y.x.norm());
        moved = true;
        if (!pencil_.indefinite || change.norm() <= kEnough * size) break;
      }
    }
    if (moved) values();
  }

  /// Repeats until the wanted values stand still. What a step changes, the next one would change
  /// by the square of the ratio to the last value of the block: that is the error left.
  void iterate_to_convergence() {
    constexpr int kSteps = 4;
    values();
    if (X_.cols() == 0) return;  // rigid motions and massless coordinates only
    for (int step = 0; step < kSteps; ++step) {
      const VectorXd before = pairs_.value;
      inverse_iteration();
      const VectorXd& now = pairs_.value;
      if (X_.cols() == 0) return;
      const VectorXd change =
          (now - before.head(now.size())).cwiseAbs().cwiseQuotient(now.cwiseAbs());
      const VectorXd ratio = now / now[now.size() - 1];
      pairs_.error = change.cwiseProduct(ratio.cwiseAbs2());
      const Index wanted = std::min(count_, now.size());  // none when rigid motions are all
      if (wanted == 0 || change.head(wanted).maxCoeff() < kConvergenceTolerance) return;
    }
  }

  /// One inverse iteration of the whole block with refined solutions, then Rayleigh-Ritz with K's
  /// exact products, in the form (K - s B)^-1 B so that the lowest values keep all their digits.
  void inverse_iteration() {
    const Index p = X_.cols();
    MatrixXd Y(X_.rows(), p);
    for (Index j = 0; j < p; ++j) {
      const RefinedSolution y =
          refined_solve([this](const VectorXd& x) { return apply(x); }, factorization_,
                        pencil_.B->transpose() * X_.col(j),
                        X_.col(j) / (pairs_.value[j] - pencil_.shift), counters_);
      inverse_iteration_failed_ = inverse_iteration_failed_ || !(y.correction < 0.1);
      Y.col(j) = y.x;
      remove_null(Y.col(j));
      orthogonalise(Y, j);
    }
    MatrixXd A = pencil_.K_products(Y);
    const MatrixXd B = Y.transpose() * (pencil_.B->transpose() * Y);
    if (pencil_.shift != 0) A -= pencil_.shift * B;
    const VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
    const SymmetricEigenpairs<MatrixXd> ritz = symmetric_eigenpairs(
        scale.asDiagonal() * B * scale.asDiagonal(), scale.asDiagonal() * A * scale.asDiagonal());
    inverse_iteration_failed_ = inverse_iteration_failed_ || !ritz.converged;
    X_ = Y * (scale.asDiagonal() * ritz.vector.rowwise().reverse());
    values();
  }

  /// In K - s B, against the columns before it; normalised. Again where most of it went: else a
  /// second pass would only find rounding (Daniel, Gragg, Kaufman and Stewart 1976).
  void orthogonalise(MatrixXd& Y, Index j) const {
    for (const bool first : {true, false}) {
      VectorXd image = pencil_.K->transpose() * Y.col(j);
      if (pencil_.shift != 0) image -= pencil_.shift * (pencil_.B->transpose() * Y.col(j));
      const VectorXd part = Y.leftCols(j).transpose() * image;
      const double whole = Y.col(j).dot(image), left = whole - part.squaredNorm();
      Y.col(j) -= Y.leftCols(j) * part;
      if (first && !(left > 0.5 * whole)) continue;
      Y.col(j) /= std::sqrt(std::abs(left));
      return;
    }
  }

  /// Rayleigh quotients, ascending.
  void values() {
    if (pencil_.indefinite) keep_positive();
    const Index p = X_.cols();
    const VectorXd energy = pencil_.K_products(X_).diagonal();
    const MatrixXd BX = pencil_.B->transpose() * X_;
    const VectorXd norm = X_.cwiseProduct(BX).colwise().sum();
    const VectorXd value = energy.cwiseQuotient(norm);
    X_ *= norm.cwiseAbs().cwiseSqrt().cwiseInverse().asDiagonal();
    std::vector<Index> order(static_cast<std::size_t>(p));
    for (Index j = 0; j < p; ++j) order[static_cast<std::size_t>(j)] = j;
    std::stable_sort(order.begin(), order.end(),
                     [&value](Index a, Index b) { return value[a] < value[b]; });
    pairs_.value.resize(p);
    MatrixXd sorted(X_.rows(), p);
    for (Index j = 0; j < p; ++j) {
      pairs_.value[j] = value[order[static_cast<std::size_t>(j)]];
      sorted.col(j) = X_.col(order[static_cast<std::size_t>(j)]);
    }
    X_ = std::move(sorted);
  }

  /// Without the vectors whose x^T B x is not positive but by rounding: where there are no more
  /// eigenvalues, the null space of B offers some, which turn to its negative ones.
  void keep_positive() {
    const MatrixXd BX = pencil_.B->transpose() * X_;
    const MatrixXd terms = pencil_.B->cwiseAbs().transpose() * X_.cwiseAbs();
    const VectorXd product = X_.cwiseProduct(BX).colwise().sum();
    const VectorXd size = X_.cwiseAbs().cwiseProduct(terms).colwise().sum();
    const double rounding = static_cast<double>(X_.rows()) * kEps;
    Index kept = 0;
    for (Index j = 0; j < X_.cols(); ++j) {
      if (product[j] <= rounding * size[j]) continue;
      X_.col(kept) = X_.col(j);
      ++kept;
    }
    X_.conservativeResize(Eigen::NoChange, kept);
  }

  /// Largest relative change of the values in the matrix that is factored, whose entries are
  /// rounded: a count by its inertia knows no smaller differences.
  [[nodiscard]] double rounding_of_values() const {
    if (X_.cols() == 0) return 0;
    const MatrixXd KX = pencil_.K->transpose() * X_;
    const VectorXd value = X_.cwiseProduct(KX).colwise().sum();
    return (value - pairs_.value).cwiseQuotient(pairs_.value).cwiseAbs().maxCoeff();
  }

  /// How many eigenvalues there are below a shift that cuts no cluster; `checked_` were found.
  Index sturm_check() {
    const VectorXd& v = pairs_.value;
    const Index p = v.size();
    const double rounding = rounding_of_values();
    const Index cut = cluster_boundary(rounding);
    checked_ = cut + null_.cols();
    for (const double fraction : {0.5, 0.37, 0.61, 0.45}) {  // until no pivot comes near zero
      if (p == 0) {
        pairs_.check_shift = std::abs(pencil_.shift) * fraction;
      } else if (cut == p) {
        pairs_.check_shift = v[p - 1] * (1 + 2e-6 * fraction);
      } else {
        pairs_.check_shift = v[cut - 1] + fraction * (v[cut] - v[cut - 1]);
      }
      factorization_.compute(shifted(*pencil_.K, *pencil_.B, pairs_.check_shift));
      ++counters_.factorizations;
      if (factorization_.is_reliable()) break;
    }
    const auto distance = [&](Index j) { return std::abs(pairs_.check_shift / v[j] - 1); };
    clear_of_rounding_ =
        p == 0 || (distance(cut - 1) > rounding && (cut == p || distance(cut) > rounding));
    pairs_.inertia_count = factorization_.exists() ? factorization_.negative_pivots() : -1;
    return pairs_.inertia_count;
  }

  /// Whether B has more positive eigenvalues than pairs were found, which are fewer than wanted:
  /// the others are so far from the first that its rounding hides them.
  [[nodiscard]] bool some_are_hidden() {
    constexpr double kNoMass = 1e-12;  // of B scaled to a unit diagonal
    if (X_.cols() >= count_ || pencil_.indefinite) return false;
    const VectorXd diagonal = pencil_.B->diagonal();
    SparseMatrix B = *pencil_.B;
    for (Index i = 0; i < B.rows(); ++i) {
      B.coeffRef(i, i) -= diagonal[i] > 0 ? kNoMass * diagonal[i] : 1;  // a row of zeros
    }
    factorization_.compute(B);
    ++counters_.factorizations;
    return factorization_.exists() && B.rows() - factorization_.negative_pivots() > checked_;
  }

  /// Number of found values below a gap: the first clear one at or after the wanted, or the widest.
  [[nodiscard]] Index cluster_boundary(double rounding) const {
    const VectorXd& v = pairs_.value;
    const Index p = v.size();
    const auto gap = [&v](Index k) { return (v[k] - v[k - 1]) / v[k]; };
    Index cut = p;
    for (Index k = std::max<Index>(std::min(count_, p), 1); k < p; ++k) {
      if (cut == p || gap(k) > gap(cut)) cut = k;
      if (gap(k) > std::max(kClusterGap, 4 * rounding)) break;
    }
    return cut < p && gap(cut) < 1e-7 ? p : cut;
  }

  /// No pair at all, also where values stood already.
  Eigenpairs no_eigenpairs() {
    pairs_ = {};
    pairs_.outcome = {Status::not_converged, kIllConditioned};
    pairs_.vector.resize(pencil_.K->rows(), 0);
    return pairs_;
  }

  Eigenpairs report_missing_eigenpairs(Index expected) {
    pairs_.outcome = {Status::not_converged, std::to_string(checked_) +
                                                 " eigenvalues were found where the inertia of the "
                                                 "matrices counts " +
                                                 std::to_string(expected)};
    finish();
    return pairs_;
  }

  Eigenpairs report_hidden_eigenpairs() {
    pairs_.outcome = {Status::not_converged, "only " + std::to_string(checked_) +
                                                 " eigenvalues were found: the others are too far "
                                                 "from the first for double precision"};
    finish();
    return pairs_;
  }

  void finish() {
    const Index kept = std::min(count_, X_.cols());
    pairs_.value.conservativeResize(kept);
    pairs_.vector = X_.leftCols(kept);
    pairs_.error.conservativeResize(kept);
  }

  const Pencil& pencil_;
  const MatrixXd& null_;
  Index count_;
  Counters& counters_;
  EigenpairProvider provider_;
  Factorization& factorization_;
  MatrixXd X_;
  Index checked_ = 0;
  bool clear_of_rounding_ = true;          // the shift of the last count, from what is found
  bool inverse_iteration_failed_ = false;  // an inverse iteration that does not converge
  Eigenpairs pairs_;
};

}  // namespace

Eigenpairs lowest_eigenpairs(const Pencil& pencil, const Eigen::MatrixXd& null, Index count,
                             EigenMethod method, Factorization& factorization, Counters& counters) {
  return Solver(pencil, null, count, method, factorization, counters).run();
}

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
  return A.isCompressed() && B.isCompressed() && A.cols() == B.cols() &&
         A.nonZeros() == B.nonZeros() &&
         std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

SparseMatrix shifted(const SparseMatrix& K, const SparseMatrix& B, double t) {
  if (!same_pattern(K, B)) return K - t * B;
  SparseMatrix A = K;
  A.coeffs() -= t * B.coeffs();
  return A;
}

}  // namespace trammel::solver
