#include "solver/statics/zero_energy_modes.h"

#include "solver/assembly/strain.h"
#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/dense_qr.h"
#include "solver/linalg/lanczos.h"

namespace trammel::solver {
namespace {

constexpr double kShift = 1e-12;  // of the diagonal
/// Pivots below it make us look: those of a mechanism are rounding, 1.2e-9 in 1,152 coordinates
/// where all of it has one sign.
constexpr double kSmallPivot = 1e-8;
constexpr double kDeformation = 1e-28;  // of the magnitude, (45 eps)^2: below it, nothing deforms
constexpr Index kMaxModes = 48;

/// Inverse iteration with K + t D on a block, D the diagonal of K; columns stay orthonormal in D.
class ShiftedIteration {
 public:
  ShiftedIteration(const System& system, Counters& counters)
      : system_(system), counters_(counters), diagonal_(system.K.diagonal()) {
    const double largest = diagonal_.size() > 0 ? diagonal_.maxCoeff() : 0;
    for (Index i = 0; i < diagonal_.size(); ++i) {
      if (diagonal_[i] <= 0) diagonal_[i] = largest > 0 ? largest : 1;
    }
    SparseMatrix shifted = system.K;
    for (Index i = 0; i < diagonal_.size(); ++i) {
      shifted.coeffRef(i, i) += kShift * diagonal_[i];
    }
    factorization_.compute(shifted);
    ++counters_.factorizations;
  }

  /// Ritz vectors by rising strain energy; NaN where they did not converge.
  Eigen::MatrixXd run(Index block) {
    const Eigen::VectorXd root = diagonal_.cwiseSqrt();
    Eigen::MatrixXd X = start_vectors(diagonal_.size(), block);
    for (int step = 0; step < 3; ++step) {
      for (Index j = 0; j < block; ++j) X.col(j) = solve(diagonal_.cwiseProduct(X.col(j)));
      X = root.cwiseInverse().asDiagonal() * thin_qr(root.asDiagonal() * X).Q;
    }
    const Eigen::MatrixXd energy = strain_products(system_, system_.T * X);
    return X * symmetric_eigenpairs(energy).vector;
  }

 private:
  Eigen::VectorXd solve(const Eigen::VectorXd& b) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(b.size());
    Eigen::VectorXd residual = b;
    for (int step = 0; step < 4; ++step) {
      x += factorization_.solve(residual);
      ++counters_.solves;
      residual = b - system_.T.transpose() * internal_forces(system_, system_.T * x) -
                 kShift * diagonal_.cwiseProduct(x);
    }
    return x;
  }

  const System& system_;
  Counters& counters_;
  Eigen::VectorXd diagonal_;
  Factorization factorization_;
};

}  // namespace

ZeroEnergyModes find_zero_energy_modes(const System& system, const Factorization& K,
                                       Counters& counters) {
  const Index n = system.K.rows();
  ZeroEnergyModes modes{Eigen::MatrixXd(n, 0), true};
  if (n == 0 || (K.exists() && K.smallest_pivot() > kSmallPivot)) return modes;
  ShiftedIteration iteration(system, counters);
  for (Index block = std::min<Index>(4, n);; block = std::min({3 * block, n, kMaxModes})) {
    const Eigen::MatrixXd X = iteration.run(block);
    if (!X.allFinite()) {
      modes.all_found = false;
      return modes;
    }
    Index count = 0;
    while (count < block) {
      const Eigen::VectorXd u = system.T * X.col(count);
      const double energy = strain_products(system, u)(0, 0);
      // x^T D x = 1 stands for parts that nothing deforms, whatever they do.
      if (!(energy <= kDeformation * std::max(1.0, strain_magnitude(system, u)))) break;
      ++count;
    }
    modes.basis = X.leftCols(count);
    modes.all_found = count < block || block == n;
    if (modes.all_found || block == kMaxModes) return modes;
  }
}

}  // namespace trammel::solver
