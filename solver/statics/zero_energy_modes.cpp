#include "solver/statics/zero_energy_modes.h"

#include <Eigen/QR>

#include "solver/assembly/strain.h"
#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/lanczos.h"
#include "solver/linalg/refinement.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShift = 1e-12;  // of the diagonal
/// Pivots below it make us look: those of a mechanism are rounding, 1.2e-9 in 1,152 coordinates
/// where all of it has one sign.
constexpr double kSmallPivot = 1e-8;
constexpr double kDeformation = 1e-28;  // of the magnitude, (45 eps)^2: below it, nothing deforms
constexpr Index kMaxModes = 48;

}  // namespace

ZeroEnergyModes find_zero_energy_modes(const System& system, const Factorization& K,
                                       Counters& counters) {
  const Index n = system.K.rows();
  ZeroEnergyModes modes{MatrixXd(n, 0), true};
  if (n == 0 || (K.exists() && K.smallest_pivot() > kSmallPivot)) return modes;
  // Inverse iteration with K + t D on a block, D the diagonal of K, orthonormal in D.
  VectorXd D = system.K.diagonal();
  const double largest = D.maxCoeff();
  D = D.unaryExpr([&](double d) { return d > 0 ? d : largest > 0 ? largest : 1; }).eval();
  SparseMatrix shifted = system.K;
  for (Index i = 0; i < n; ++i) shifted.coeffRef(i, i) += kShift * D[i];
  Factorization factorization;
  factorization.compute(shifted);
  ++counters.factorizations;
  const Operator shifted_K = [&,
                              elastic = stiffness_operator(system)](const VectorXd& x) -> VectorXd {
    return elastic(x) + kShift * D.cwiseProduct(x);
  };
  const VectorXd root = D.cwiseSqrt();
  for (Index block = std::min<Index>(4, n);; block = std::min({3 * block, n, kMaxModes})) {
    MatrixXd X = start_vectors(n, block);
    for (int step = 0; step < 3; ++step) {
      for (Index j = 0; j < block; ++j) {
        const VectorXd b = D.cwiseProduct(X.col(j));
        X.col(j) = refined_solve(shifted_K, factorization, b, counters).x;
      }
      const Eigen::HouseholderQR<MatrixXd> qr(root.asDiagonal() * X);
      X = qr.householderQ() * MatrixXd::Identity(n, block);
      X = root.cwiseInverse().asDiagonal() * X;
    }
    // Ritz vectors by rising strain energy; NaN if they did not converge.
    X = X * symmetric_eigenpairs(strain_products(system, system.T * X)).vector;
    if (!X.allFinite()) {
      modes.all_found = false;
      return modes;
    }
    Index count = 0;
    while (count < block) {
      const VectorXd u = system.T * X.col(count);
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
