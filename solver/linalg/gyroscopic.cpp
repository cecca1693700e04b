#include "solver/linalg/gyroscopic.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "solver/linalg/dense_eigen.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// Linearization A z = s G z of the gyroscopic eigenvalue problem with z = (x, s x_m), s = i w and
/// the angular frequency w:
///
///   A = diag(K, M),  G = [-C, -M; M, 0].
///
/// x_m are the coordinates that have mass.
struct Linearization {
  SparseMatrix mass, A, G;
};

Linearization linearize_pencil(const GyroscopicPencil& pencil) {
  // Relative increase of the diagonal of the mass matrix, which makes it positive definite. Without
  // the increase, the matrix would be singular if a point mass has an offset from its node.
  constexpr double kHelp = 1e-12;
  const Index n = pencil.K.rows();
  const VectorXd diagonal = pencil.M.diagonal();
  std::vector<Eigen::Triplet<double>> massive;
  for (Index i = 0; i < n; ++i)
    if (diagonal[i] > 0) massive.emplace_back(static_cast<int>(massive.size()), i, 1.0);
  SparseMatrix S(std::ssize(massive), n);
  S.setFromTriplets(massive.begin(), massive.end());
  const Index m = S.rows();
  SparseMatrix upper(n + m, n), lower(n + m, m);  // columns of the identity matrix
  for (Index i = 0; i < n; ++i) upper.insert(i, i) = 1;
  for (Index i = 0; i < m; ++i) lower.insert(n + i, i) = 1;
  const auto block = [](const SparseMatrix& row, const SparseMatrix& A,
                        const SparseMatrix& column) {
    return SparseMatrix(row * A * column.transpose());
  };
  const SparseMatrix coupling = block(lower, S * pencil.M, upper);
  Linearization linear;
  linear.mass = S * pencil.M * S.transpose();
  for (Index i = 0; i < m; ++i) linear.mass.coeffRef(i, i) *= 1 + kHelp;
  linear.A = block(upper, pencil.K, upper) + block(lower, linear.mass, lower);
  linear.G = coupling - SparseMatrix(coupling.transpose()) - block(upper, pencil.C, upper);
  return linear;
}

/// Returns the Rayleigh functional of a mode shape x: the positive root w of x^H (K + i w C - w^2
/// M) x = 0.
double frequency_of_shape(const GyroscopicPencil& pencil, const VectorXcd& x) {
  const VectorXd a = x.real(), b = x.imag();
  MatrixXd parts(x.size(), 2);
  parts << a, b;
  const double k = pencil.K_products(parts).trace();
  const double m = a.dot(pencil.M * a) + b.dot(pencil.M * b);
  const double c = -2 * a.dot(pencil.C * b);
  return (c + std::sqrt(c * c + 4 * m * k)) / (2 * m);
}

}  // namespace

std::optional<Index> gyroscopic_sturm_count(const GyroscopicPencil& pencil, double omega) {
  using ComplexMatrix = Eigen::SparseMatrix<Complex>;
  const ComplexMatrix H = (pencil.K - omega * omega * pencil.M).cast<Complex>() +
                          Complex(0, omega) * pencil.C.cast<Complex>();
  const Eigen::SimplicialLDLT<ComplexMatrix> ldlt(H);
  if (ldlt.info() != Eigen::Success) return std::nullopt;
  return (ldlt.vectorD().real().array() < 0).count();
}

GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil, Index count,
                                        EigenMethod method, Counters& counters) {
  constexpr Index kDenseSize = 150;
  const Index n = pencil.K.rows();
  const auto& [mass_matrix, A, gyroscopic_matrix] = linearize_pencil(pencil);
  const SparseMatrix &mass = mass_matrix, &G = gyroscopic_matrix;  // names that lambdas can capture
  Factorization factorization;
  factorization.compute(A);
  ++counters.factorizations;
  Pencil linear;
  linear.K = &A;
  linear.K_times = [&](const VectorXd& z) -> VectorXd {
    VectorXd y(z.size());
    y << pencil.K_times(z.head(n)), mass * z.tail(mass.rows());
    return y;
  };
  linear.K_products = [&](const MatrixXd& Z) -> MatrixXd {
    const MatrixXd velocity = Z.bottomRows(mass.rows());
    return pencil.K_products(Z.topRows(n)) + velocity.transpose() * (mass * velocity);
  };
  linear.B_times = [&](const VectorXd& z) -> VectorXd {
    ++counters.solves;
    return G.transpose() * factorization.solve(G * z);
  };
  linear.count_below = [&](double w2) -> std::optional<Index> {
    ++counters.factorizations;
    const std::optional<Index> below = gyroscopic_sturm_count(pencil, std::sqrt(w2));
    return below ? std::optional(2 * *below) : std::nullopt;
  };
  const bool dense = method == EigenMethod::automatic && n <= kDenseSize;
  const Eigenpairs pairs =
      lowest_eigenpairs(linear, MatrixXd(A.rows(), 0), 2 * count,
                        dense ? EigenMethod::dense : method, factorization, counters);
  GyroscopicModes modes;
  modes.outcome = pairs.outcome;
  const Index kept = std::min(count, pairs.value.size() / 2);
  modes.omega.resize(kept);
  modes.shape.resize(n, kept);
  modes.growth_rate.setZero(kept);
  if (kept == 0) {
    if (modes.outcome.solved())
      modes.outcome = {Status::not_converged, "no finite frequency was found"};
    return modes;
  }
  // Solve the Hermitian eigenvalue problem of i G in the space of the computed vectors z
  // (Rayleigh-Ritz). The vectors are divided by w, because z^T A z = w^2. The eigenvalues are 1 / w
  // and -1 / w.
  const MatrixXd V = pairs.vector * pairs.value.cwiseSqrt().cwiseInverse().asDiagonal();
  const MatrixXd skew = V.transpose() * (G * V);
  const Eigen::SelfAdjointEigenSolver<MatrixXcd> ritz(Complex(0, 0.5) * (skew - skew.transpose()));
  for (Index j = 0; j < kept; ++j) {
    const VectorXcd x = V.topRows(n) * ritz.eigenvectors().col(V.cols() - 1 - j);
    modes.shape.col(j) = x.normalized();
    modes.omega[j] = frequency_of_shape(pencil, modes.shape.col(j));
  }
  return modes;
}

GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil) {
  // Solve G z = mu A z with mu = 1 / s, in coordinates scaled to a unit diagonal of |A|.
  GyroscopicModes modes;
  const Index n = pencil.K.rows();
  const Linearization linear = linearize_pencil(pencil);
  const VectorXd scale = linear.A.diagonal().cwiseAbs().unaryExpr(
      [](double d) { return d > 0 ? 1 / std::sqrt(d) : 1; });
  const auto scaled = [&scale](const SparseMatrix& matrix) -> MatrixXd {
    return scale.asDiagonal() * MatrixXd(matrix) * scale.asDiagonal();
  };
  const ComplexEigenpairs pairs =
      eigenpairs(Eigen::PartialPivLU<MatrixXd>(scaled(linear.A)).solve(scaled(linear.G)));
  if (!pairs.converged) {
    modes.outcome = {Status::not_converged, "the dense eigenvalue iteration did not converge"};
    return modes;
  }
  struct Root {
    double omega, growth_rate;
    Index column;
  };
  std::vector<Root> roots;
  const double largest = pairs.value.cwiseAbs().maxCoeff();
  for (Index j = 0; j < pairs.value.size(); ++j) {
    const Complex mu = pairs.value[j];
    if (std::abs(mu) < 1e-9 * largest) continue;  // infinite eigenvalue of a massless coordinate
    Complex lambda = 1.0 / mu;
    if (std::abs(lambda.real()) < 1e-7 * std::abs(lambda)) lambda.real(0);
    if (std::abs(lambda.imag()) < 1e-7 * std::abs(lambda)) lambda.imag(0);
    const bool once = lambda.imag() > 0 || (lambda.imag() == 0 && lambda.real() > 0);
    if (once) roots.push_back({lambda.imag(), lambda.real(), j});
  }
  std::stable_sort(roots.begin(), roots.end(),
                   [](const Root& a, const Root& b) { return a.omega < b.omega; });
  const auto count = static_cast<Index>(roots.size());
  modes.omega.resize(count);
  modes.growth_rate.resize(count);
  modes.shape.resize(n, count);
  for (Index j = 0; j < count; ++j) {
    const Root& root = roots[static_cast<std::size_t>(j)];
    modes.omega[j] = root.omega;
    modes.growth_rate[j] = root.growth_rate;
    const VectorXcd x = scale.head(n).cwiseProduct(pairs.vector.col(root.column).head(n));
    modes.shape.col(j) = x.normalized();
  }
  return modes;
}

}  // namespace trammel::solver
