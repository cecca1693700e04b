#include "solver/linalg/eigenpairs.h"

#include <Spectra/SymEigsSolver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>

#include "solver/linalg/dense_eigen.h"

namespace trammel::solver {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Number of coordinates above which Lanczos' method computes a few modes faster than the dense
// method.
constexpr Index kDenseSize = 64;
constexpr double kConvergenceTolerance =
    1e-11;  // relative change of an eigenvalue in one inverse iteration
// Relative gap above which adjacent eigenvalues count as distinct instead of as copies of a
// repeated eigenvalue.
constexpr double kClusterGap = 1e-3;

// Products with the symmetric matrices K and B use the transposed matrix, because Eigen then sums
// each row in registers.

/// Solves A x = lambda B x in coordinates scaled to a unit diagonal of B.
SymmetricEigenpairs eigenpairs_by_scaling(const MatrixXd& A, const MatrixXd& B) {
  const VectorXd scale = B.diagonal().cwiseSqrt().cwiseInverse();
  SymmetricEigenpairs pairs = symmetric_eigenpairs(scale.asDiagonal() * A * scale.asDiagonal(),
                                                   scale.asDiagonal() * B * scale.asDiagonal());
  pairs.vector = scale.asDiagonal() * pairs.vector;
  return pairs;
}

class Solver {
 public:
  Solver(const Pencil& pencil, const MatrixXd& null, Index count, EigenMethod method,
         Factorization& factorization, Counters& counters)
      : pencil_(pencil),
        null_(null),
        count_(count),
        size_(pencil.K->rows()),
        dense_(method == EigenMethod::dense || size_ < 4 ||
               (method == EigenMethod::automatic && size_ <= kDenseSize)),
        counters_(counters),
        factorization_(factorization),
        X_(size_, 0) {}

  Eigenpairs run() {
    constexpr int kRounds = 40, kUncertainRounds = 8;
    if (!factorization_.is_nonsingular() || factorization_.smallest_pivot() <= 0)
      return no_eigenpairs();
    add(next_block(count_ + 3 + count_ / 4));
    for (int round = 0; round < kRounds; ++round) {
      iterate_to_convergence();
      if (failed_) return no_eigenpairs();
      const Index expected = sturm_check();
      if (clear_of_rounding_) {
        if (expected == checked_) break;
        if (expected < checked_ || round + 1 == kRounds) return missing_eigenpairs(expected);
      } else if (round + 1 >= kUncertainRounds) {
        return no_eigenpairs();
      }
      factor(pencil_.shift);
      const Index before = X_.cols();
      add(next_block(std::max<Index>(0, expected - checked_) + 2));
      if (X_.cols() > before) continue;
      if (expected != checked_) return missing_eigenpairs(expected);
      if (!dense_) return no_eigenpairs();
      break;
    }
    if (some_are_hidden())
      return finish("only " + std::to_string(checked_) +
                    " eigenvalues were found: the remaining eigenvalues are too large relative "
                    "to the first eigenvalue for double precision");
    iterate_beside_each();
    return finish({});
  }

 private:
  void factor(double t) {
    if (!pencil_.B) return;
    factorization_.compute(shifted_matrix(*pencil_.K, *pencil_.B, t));
    ++counters_.factorizations;
  }

  [[nodiscard]] MatrixXd times_B(const MatrixXd& X) const {
    if (pencil_.B) return pencil_.B->transpose() * X;
    MatrixXd BX(X.rows(), X.cols());
    for (Index j = 0; j < X.cols(); ++j) BX.col(j) = pencil_.B_times(X.col(j));
    return BX;
  }

  /// Returns (K - s B) x, where K x is computed by the accurate operator `K_times` of the pencil.
  [[nodiscard]] VectorXd apply(const VectorXd& x) const {
    VectorXd y = pencil_.K_times(x);
    if (pencil_.shift != 0) y -= pencil_.shift * times_B(x);
    return y;
  }

  /// Returns (K - s B) x, where K x is computed with the assembled matrix K.
  [[nodiscard]] VectorXd assembled(const VectorXd& x) const {
    VectorXd y = pencil_.K->transpose() * x;
    if (pencil_.shift != 0) y -= pencil_.shift * times_B(x);
    return y;
  }

  /// Returns about `count` further eigenvectors with the largest mu = 1 / (lambda - s) > 0, or all
  /// remaining eigenvectors. If Lanczos' method fails, fewer eigenvectors are returned.
  MatrixXd next_block(Index count) {
    if (!dense_) return lanczos(count);
    if (all_.rows() == 0) {
      all_ = dense_vectors();
      taken_ = std::min(null_.cols(), all_.cols());  // skip null vectors, which have the largest mu
    }
    const Index kept = std::min(count, all_.cols() - taken_);
    taken_ += kept;
    return all_.middleCols(taken_ - kept, kept);
  }

  /// Returns all eigenvectors with mu = 1 / (lambda - s) > 0 in descending order of mu.
  MatrixXd dense_vectors() {
    const MatrixXd B = times_B(MatrixXd::Identity(size_, size_));
    const auto pairs = eigenpairs_by_scaling(B, MatrixXd(*pencil_.K) - pencil_.shift * B);
    failed_ = !pairs.converged;
    if (failed_) return MatrixXd(size_, 0);
    const double zero = static_cast<double>(size_) * kEps * pairs.value.cwiseAbs().maxCoeff();
    return pairs.vector.rightCols((pairs.value.array() > zero).count()).rowwise().reverse();
  }

  /// Computes up to `count` eigenvectors x = F^-T y of the pencil by Lanczos' method, where y are
  /// eigenvectors of F^-1 B F^-T, and F F^T = K - s B. In the inner product of K - s B, the vectors
  /// x are orthogonal to the known eigenvectors.
  [[nodiscard]] MatrixXd lanczos(Index count) const {
    const Index known_count = null_.cols() + X_.cols(), dimension = size_ - known_count;
    const Index wanted = std::min(count, dimension - 1);
    if (wanted < 1 || (pencil_.B && pencil_.B->norm() == 0)) return MatrixXd(size_, 0);
    MatrixXd known(size_, known_count);  // known eigenvectors x, as y = F^T x = F^-1 (K - s B) x
    known << null_, X_;
    for (Index j = 0; j < known_count; ++j) {
      known.col(j) = factorization_.apply_inverse_factor(assembled(known.col(j)));
      for (int pass = 0; pass < 2; ++pass)
        known.col(j) -= known.leftCols(j) * (known.leftCols(j).transpose() * known.col(j));
      known.col(j).normalize();
    }
    const auto complement = [&known](VectorXd x) {
      if (known.cols() > 0) x.noalias() -= known * (known.transpose() * x);
      return x;
    };
    const auto apply = [&](const Eigen::Ref<const VectorXd>& x) -> VectorXd {
      const VectorXd p = factorization_.apply_inverse_factor_transposed(complement(x));
      ++counters_.solves;
      return complement(factorization_.apply_inverse_factor(times_B(p)));
    };
    const Index subspace = std::min(dimension, std::max(2 * wanted + 1, wanted + 20));
    const auto [mu, Y] = largest_eigenpairs(apply, complement(start_vectors(size_, 1, known_count)),
                                            {.wanted = wanted, .subspace = subspace});
    const double zero = 1e3 * kEps * (mu.size() > 0 ? std::abs(mu[0]) : 0.0);
    MatrixXd found(size_, (mu.array() > zero).count());
    for (Index j = 0; j < found.cols(); ++j)
      found.col(j) = factorization_.apply_inverse_factor_transposed(complement(Y.col(j)));
    return found;
  }

  /// Makes x B-orthogonal to the known vectors of the null space of K.
  void remove_null(Eigen::Ref<VectorXd> x) const {
    if (null_.cols() > 0) x -= null_ * (null_.transpose() * times_B(x));
  }

  void add(const MatrixXd& found) {
    const Index old = X_.cols();
    X_.conservativeResize(Eigen::NoChange, old + found.cols());
    X_.rightCols(found.cols()) = found;
    for (Index j = old; j < X_.cols(); ++j) remove_null(X_.col(j));
  }

  /// Improves eigenvectors by inverse iteration with a shift t just below their eigenvalue. The
  /// function does this for indefinite pencils, and for eigenvalues far above the first eigenvalue.
  /// The round-off error of (K - s B)^-1 B is proportional to the largest eigenvalue |mu| of this
  /// matrix. The error contaminates the eigenvector of a smaller mu in proportion to the ratio of
  /// the two values mu. With the shift t, the mu of the requested eigenvector is the largest.
  /// Deflation is no alternative, because eigenvectors with negative mu are unknown.
  void iterate_beside_each() {
    constexpr double kAside = 1e-4, kWideSpread = 1e4;
    constexpr int kPasses = 4;
    // Relative change of the eigenvector below which the inverse iteration ends. Each pass reduces
    // the components along other eigenvectors by the factor kAside.
    constexpr double kEnough = 1e-9;
    const Index wanted = std::min(count_, X_.cols());
    if (wanted == 0 || !pencil_.B) return;
    bool moved = false;
    const double first = null_.cols() > 0 ? 0 : pairs_.value[0];
    for (Index j = 0; j < wanted; ++j) {
      const double spread = (pairs_.value[j] - pencil_.shift) / (first - pencil_.shift);
      if (!pencil_.indefinite && !(spread > kWideSpread)) continue;
      const double t = pairs_.value[j] * (1 - kAside);
      factor(t);
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

  /// Repeats the inverse iteration until the requested eigenvalues converge. The next iteration
  /// would change an eigenvalue by about its last change times r^2. r is the ratio of the
  /// eigenvalue to the largest eigenvalue of the block. This product, last change times r^2, is the
  /// estimate of the remaining error.
  void iterate_to_convergence() {
    constexpr int kSteps = 4;
    values();
    if (X_.cols() == 0) return;  // the model has only rigid modes and massless coordinates
    for (int step = 0; step < kSteps; ++step) {
      const VectorXd before = pairs_.value;
      inverse_iteration();
      const VectorXd& now = pairs_.value;
      if (X_.cols() == 0) return;
      const VectorXd change =
          (now - before.head(now.size())).cwiseAbs().cwiseQuotient(now.cwiseAbs());
      const VectorXd ratio = now / now[now.size() - 1];
      pairs_.error = change.cwiseProduct(ratio.cwiseAbs2());
      const Index wanted = std::min(count_, now.size());  // zero if all requested modes are rigid
      if (wanted == 0 || change.head(wanted).maxCoeff() < kConvergenceTolerance) return;
    }
  }

  /// Performs one inverse iteration of all vectors of the block with iteratively refined solutions.
  /// A Rayleigh-Ritz step with accurate products K x follows. Because the iteration matrix is (K -
  /// s B)^-1 B, all digits of the lowest eigenvalues are retained.
  void inverse_iteration() {
    const MatrixXd BX = times_B(X_);
    MatrixXd Y(size_, X_.cols());
    for (Index j = 0; j < Y.cols(); ++j) {
      const RefinedSolution y =
          refined_solve([this](const VectorXd& x) { return apply(x); }, factorization_, BX.col(j),
                        X_.col(j) / (pairs_.value[j] - pencil_.shift), counters_);
      failed_ = failed_ || !(y.correction < 0.1);
      Y.col(j) = y.x;
      remove_null(Y.col(j));
      orthogonalise(Y, j);
    }
    MatrixXd A = pencil_.K_products(Y);
    const MatrixXd B = Y.transpose() * times_B(Y);
    if (pencil_.shift != 0) A -= pencil_.shift * B;
    const SymmetricEigenpairs ritz = eigenpairs_by_scaling(B, A);
    failed_ = failed_ || !ritz.converged;
    X_ = Y * ritz.vector.rowwise().reverse();
    values();
  }

  /// Orthonormalizes column j of Y against the preceding columns in the inner product of K - s B. A
  /// second pass follows if the first pass removed most of the column. The remainder is then
  /// dominated by round-off (Daniel, Gragg, Kaufman and Stewart 1976).
  void orthogonalise(MatrixXd& Y, Index j) const {
    for (const bool first : {true, false}) {
      const VectorXd image = assembled(Y.col(j));
      const VectorXd part = Y.leftCols(j).transpose() * image;
      const double whole = Y.col(j).dot(image), left = whole - part.squaredNorm();
      Y.col(j) -= Y.leftCols(j) * part;
      if (first && !(left > 0.5 * whole)) continue;
      Y.col(j) /= std::sqrt(std::abs(left));
      return;
    }
  }

  /// Computes the Rayleigh quotients (eigenvalue estimates) of the iterated vectors. Quotients and
  /// vectors are sorted in ascending order of the quotients.
  void values() {
    if (pencil_.indefinite) keep_positive();
    const VectorXd energy = pencil_.K_products(X_).diagonal();
    const VectorXd norm = X_.cwiseProduct(times_B(X_)).colwise().sum();
    const VectorXd value = energy.cwiseQuotient(norm);
    X_ *= norm.cwiseAbs().cwiseSqrt().cwiseInverse().asDiagonal();
    std::vector<Index> order(to_size(value.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&value](Index a, Index b) { return value[a] < value[b]; });
    pairs_.value = value(order);
    X_ = X_(Eigen::all, order).eval();
  }

  /// Removes iterated vectors x for which x^T B x is negative, or zero up to round-off. If there
  /// are more iterated vectors than positive eigenvalues, such vectors from the null space of B
  /// converge to negative eigenvalues.
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

  /// Returns the largest relative change of the eigenvalues caused by round-off errors of the
  /// assembled matrix K. A count of negative pivots cannot resolve smaller relative differences of
  /// eigenvalues.
  [[nodiscard]] double rounding_of_values() const {
    if (X_.cols() == 0) return 0;
    const MatrixXd KX = pencil_.K->transpose() * X_;
    const VectorXd value = X_.cwiseProduct(KX).colwise().sum();
    return (value - pairs_.value).cwiseQuotient(pairs_.value).cwiseAbs().maxCoeff();
  }

  /// Counts the eigenvalues below the shift t and stores the count in `counted_`. Returns false if
  /// the count is unreliable.
  bool count_below(double t) {
    if (pencil_.count_below) {
      const std::optional<Index> count = pencil_.count_below(t);
      counted_ = count.value_or(-1);
      return count.has_value();
    }
    factor(t);
    counted_ = factorization_.is_nonsingular() ? factorization_.negative_pivots() : -1;
    return factorization_.is_reliable();
  }

  /// Returns the number of eigenvalues below a shift between two clusters of eigenvalues, from a
  /// count of negative pivots. Sets `checked_` to the number of computed eigenvalues below this
  /// shift.
  Index sturm_check() {
    const VectorXd& v = pairs_.value;
    const Index p = v.size();
    const double rounding = rounding_of_values();
    const Index cut = cluster_boundary(rounding);
    checked_ = cut + null_.cols();
    double& shift = pairs_.check_shift;
    // Shifts tried until no pivot is near zero.
    for (const double fraction : {0.5, 0.37, 0.61, 0.45}) {
      if (p == 0) {
        shift = std::abs(pencil_.shift) * fraction;
      } else {
        shift = cut == p ? v[p - 1] * (1 + 2e-6 * fraction)
                         : v[cut - 1] + fraction * (v[cut] - v[cut - 1]);
      }
      if (count_below(shift)) break;
    }
    const auto distance = [&](Index j) { return std::abs(shift / v[j] - 1); };
    clear_of_rounding_ =
        p == 0 || (distance(cut - 1) > rounding && (cut == p || distance(cut) > rounding));
    return counted_;
  }

  /// Returns true if fewer eigenpairs were found than requested, although B has more positive
  /// eigenvalues than pairs were found. The missing eigenvalues of the pencil are so much larger
  /// than the first eigenvalue that round-off errors hide them.
  [[nodiscard]] bool some_are_hidden() {
    constexpr double kNoMass = 1e-12;  // least relevant eigenvalue of B with unit diagonal
    if (X_.cols() >= count_ || pencil_.indefinite || !pencil_.B) return false;
    const VectorXd diagonal = pencil_.B->diagonal();
    SparseMatrix B = *pencil_.B;
    for (Index i = 0; i < B.rows(); ++i) {
      // Subtract 1 in a row of zeros, so that its pivot counts as negative.
      B.coeffRef(i, i) -= diagonal[i] > 0 ? kNoMass * diagonal[i] : 1;
    }
    factorization_.compute(B);
    ++counters_.factorizations;
    return factorization_.is_nonsingular() &&
           B.rows() - factorization_.negative_pivots() > checked_;
  }

  /// Returns the number of computed eigenvalues below a gap between clusters of eigenvalues. The
  /// gap is the first clear gap at or after the requested number of eigenvalues. If there is no
  /// clear gap, the widest gap is used.
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

  /// Returns the outcome not_converged without eigenpairs, even if some eigenvalues have converged.
  Eigenpairs no_eigenpairs() {
    pairs_ = {};
    X_.resize(size_, 0);
    return finish("the stiffness matrix is too ill-conditioned for double precision");
  }

  Eigenpairs missing_eigenpairs(Index expected) {
    return finish(std::to_string(checked_) +
                  " eigenvalues were found, but the number of negative pivots is " +
                  std::to_string(expected));
  }

  Eigenpairs finish(const std::string& failure) {
    if (!failure.empty()) pairs_.outcome = {Status::not_converged, failure};
    const Index kept = std::min(pencil_.B ? count_ : std::max(count_, checked_), X_.cols());
    pairs_.value.conservativeResize(kept);
    pairs_.vector = X_.leftCols(kept);
    pairs_.error.conservativeResize(kept);
    return pairs_;
  }

  const Pencil& pencil_;
  const MatrixXd& null_;
  Index count_, size_;
  bool dense_;
  Counters& counters_;
  Factorization& factorization_;
  MatrixXd X_;
  MatrixXd all_;     // dense method: all eigenvectors, in descending order of mu
  Index taken_ = 0;  // dense method: number of columns of `all_` used so far
  Index checked_ = 0, counted_ = 0;
  // True if the shift of the last count of negative pivots is farther from all eigenvalues than
  // their round-off error.
  bool clear_of_rounding_ = true;
  bool failed_ = false;  // an eigenvalue iteration or inverse iteration has not converged
  Eigenpairs pairs_;
};

/// Returns a shift t far above all relevant eigenvalues of A x = t B x. The shift is computed in
/// coordinates scaled to a unit diagonal of A, which makes translations and rotations comparable.
double shift_above_all_eigenvalues(const SparseMatrix& A, const SparseMatrix& B) {
  const VectorXd scale =
      A.diagonal().cwiseAbs().unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 0.0; });
  const double size = (scale.asDiagonal() * B * scale.asDiagonal()).norm();
  return size > 0 ? std::sqrt(static_cast<double>(A.rows())) / size : 0;
}

}  // namespace

Eigenpairs lowest_eigenpairs(const Pencil& pencil, const Eigen::MatrixXd& null_vectors, Index count,
                             EigenMethod method, Factorization& factorization, Counters& counters) {
  return Solver(pencil, null_vectors, count, method, factorization, counters).run();
}

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
  return A.isCompressed() && B.isCompressed() && A.cols() == B.cols() &&
         A.nonZeros() == B.nonZeros() &&
         std::equal(A.outerIndexPtr(), A.outerIndexPtr() + A.cols() + 1, B.outerIndexPtr()) &&
         std::equal(A.innerIndexPtr(), A.innerIndexPtr() + A.nonZeros(), B.innerIndexPtr());
}

SparseMatrix shifted_matrix(const SparseMatrix& K, const SparseMatrix& B, double t) {
  if (!same_pattern(K, B)) return K - t * B;
  SparseMatrix A = K;
  A.coeffs() -= t * B.coeffs();
  return A;
}

double eigenvalue_count_error(const VectorXd& found,
                              const std::function<std::optional<Index>(double)>& count_below) {
  constexpr double kClearGap = 1e-6;  // relative gap; round-off separates equal eigenvalues by less
  for (Index below = found.size() - 1; below >= 0; --below) {
    const double low = below > 0 ? found[below - 1] : 0;
    const double gap = found[below] - low;
    if (!(gap > kClearGap * found[below])) continue;
    for (const double fraction : {0.5, 0.37, 0.61, 0.83}) {
      if (const std::optional<Index> counted = count_below(low + fraction * gap))
        return static_cast<double>(std::abs(*counted - below));
    }
  }
  const bool nothing_swings = found.size() == 0 || found[found.size() - 1] == 0;
  return nothing_swings ? 0 : kInfinity;
}

double eigenvalue_count_error(const SparseMatrix& A, const SparseMatrix& B, const VectorXd& found,
                              Factorization&& spent, double shift_above) {
  if (A.rows() == 0) return static_cast<double>(found.size());
  Factorization factorization = std::move(spent);
  const auto below = [&](double t) { return factorization.sturm_count(shifted_matrix(A, B, t)); };
  if (found.size() == 0) {  // the number of eigenvalues below a large shift must be 0
    const std::optional<Index> counted = below(shift_above_all_eigenvalues(A, B));
    return counted ? static_cast<double>(*counted) : kInfinity;
  }
  if (shift_above > found[found.size() - 1] && below(shift_above) == found.size()) return 0;
  return eigenvalue_count_error(found, below);
}

Index count_dependent_vectors(const SparseMatrix& metric, const MatrixXd& X) {
  if (X.cols() == 0) return 0;
  constexpr double kDependent = 1e-3;  // eigenvalue of scaled products; 0 for a duplicate mode
  const MatrixXd products = X.transpose() * (metric * X);
  const VectorXd scale = products.diagonal().cwiseSqrt().cwiseInverse();
  const auto pairs = symmetric_eigenpairs(scale.asDiagonal() * products * scale.asDiagonal());
  return X.cols() - (pairs.value.array() > kDependent).count();  // all vectors if a product is NaN
}

namespace {

/// Symmetric operator with the interface that the eigenvalue library Spectra requires.
struct SpectraOperator {
  using Scalar = double;
  const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply;
  Index size;
  double scale = 1;

  [[nodiscard]] Index rows() const { return size; }
  [[nodiscard]] Index cols() const { return size; }
  void perform_op(const double* in, double* out) const {
    Eigen::Map<Eigen::VectorXd>(out, size) =
        scale * apply(Eigen::Map<const Eigen::VectorXd>(in, size));
  }
};

/// Returns a power of two by which the operator is multiplied for Spectra. Spectra accepts an
/// eigenpair if its absolute error is below tolerance * eps^(2/3). With the factor, this limit is a
/// few eps times the largest eigenvalue, which is the round-off error of that eigenvalue. Returns 1
/// if the image of the start vector is zero or not finite.
double spectra_scale(const SpectraOperator& op, const Eigen::VectorXd& start, double tolerance) {
  const Eigen::VectorXd image = op.apply(start);
  // Estimate of the largest eigenvalue.
  const double largest = op.apply(image).norm() / image.norm();
  const double fitting = tolerance / std::cbrt(kEps) / 4;
  return std::isnormal(largest) ? std::exp2(std::round(std::log2(fitting / largest))) : 1;
}

}  // namespace

LanczosPairs largest_eigenpairs(
    const std::function<Eigen::VectorXd(const Eigen::Ref<const Eigen::VectorXd>&)>& apply,
    const Eigen::VectorXd& start, const LanczosOptions& options) {
  constexpr Index kMaxRestarts = 300;
  SpectraOperator op{apply, start.size()};
  op.scale = spectra_scale(op, start, options.tolerance);
  const LanczosPairs none{Eigen::VectorXd(0), Eigen::MatrixXd(start.size(), 0)};
  try {
    Spectra::SymEigsSolver<SpectraOperator> solver(op, options.wanted, options.subspace);
    solver.init(start.data());
    solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, options.tolerance);
    return {solver.eigenvalues() / op.scale, solver.eigenvectors()};
  } catch (const std::runtime_error&) {  // the projected matrix is not finite
    return none;
  } catch (const std::invalid_argument&) {  // the start vector or its image is zero
    return none;
  }
}

Eigen::MatrixXd start_vectors(Index rows, Index columns, Index variant) {
  std::mt19937_64 engine(20170204 + static_cast<std::uint64_t>(variant));
  Eigen::MatrixXd X(rows, columns);
  for (double& x : X.reshaped()) x = static_cast<double>(engine() >> 11) * 0x1p-52 - 1.0;
  return X;
}

}  // namespace trammel::solver
