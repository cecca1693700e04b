#include "solver/linalg/gyroscopic.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <optional>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/dense_lu.h"
#include "solver/linalg/lanczos.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// R with R^T R = M; rows only for the coordinates that have mass. A singular M (a point mass off
/// its node) is helped by 1e-14 of its diagonal. Nothing where a pivot is zero even so.
std::optional<SparseMatrix> mass_square_root(const SparseMatrix& M) {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Index> number(static_cast<std::size_t>(M.rows()), -1);
  std::vector<Index> massive;
  const VectorXd diagonal = M.diagonal();
  for (Index i = 0; i < M.rows(); ++i) {
    if (!(diagonal[i] > 0)) continue;
    number[static_cast<std::size_t>(i)] = static_cast<Index>(massive.size());
    massive.push_back(i);
  }
  for (Index j = 0; j < M.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(M, j); it; ++it) {
      const Index a = number[static_cast<std::size_t>(it.row())];
      const Index b = number[static_cast<std::size_t>(it.col())];
      if (a < 0 || b < 0) continue;
      entries.emplace_back(a, b, it.value() * (a == b ? 1 + 1e-14 : 1));
    }
  }
  const auto r = static_cast<Index>(massive.size());
  SparseMatrix compact(r, r);
  compact.setFromTriplets(entries.begin(), entries.end());
  SparseLdlt ldlt;
  if (!ldlt.factorize(compact)) return std::nullopt;
  const SparseMatrix root = ldlt.square_root();
  entries.clear();
  for (Index j = 0; j < root.outerSize(); ++j) {
    const auto coordinate = static_cast<int>(massive[to_size(j)]);
    for (SparseMatrix::InnerIterator it(root, j); it; ++it) {
      entries.emplace_back(static_cast<int>(it.row()), coordinate, it.value());
    }
  }
  SparseMatrix R(r, M.cols());
  R.setFromTriplets(entries.begin(), entries.end());
  return R;
}

/// W, and W^T W = -W^2 for Lanczos, in the complement of what is known.
class SkewOperator {
 public:
  SkewOperator(const GyroscopicPencil& pencil, const SparseMatrix& R, const Factorization& K,
               Counters& counters)
      : C_(pencil.C), R_(R), K_(K), counters_(counters) {}

  [[nodiscard]] Index rows() const { return C_.rows() + R_.rows(); }
  [[nodiscard]] VectorXd apply(const VectorXd& z) const {
    const Index n = C_.rows();
    const VectorXd x = displacement(z);
    VectorXd out(rows());
    out.head(n) = K_.solve_half(R_.transpose() * z.tail(R_.rows()) - C_ * x);
    out.tail(R_.rows()) = -(R_ * x);
    ++counters_.solves;
    return out;
  }

  [[nodiscard]] VectorXd displacement(const VectorXd& z) const {
    return K_.solve_half_transposed(z.head(C_.rows()));
  }

  /// W^T W z in the complement.
  [[nodiscard]] VectorXd apply_squared(const Eigen::Ref<const VectorXd>& z) const {
    return complement(-apply(apply(complement(z))));
  }

  [[nodiscard]] VectorXd complement(const VectorXd& z) const {
    if (known.cols() == 0) return z;
    return z - known * (known.transpose() * z);
  }

  MatrixXd known;  ///< orthonormal columns, closed under W

 private:
  const SparseMatrix& C_;
  const SparseMatrix& R_;
  const Factorization& K_;
  Counters& counters_;
};

/// Adds columns to an orthonormal basis, leaving out what lies in it already.
void extend(MatrixXd& basis, const MatrixXd& columns) {
  for (Index j = 0; j < columns.cols(); ++j) {
    VectorXd v = columns.col(j).normalized();
    for (int pass = 0; pass < 2; ++pass) v -= basis * (basis.transpose() * v);
    const double remainder = v.norm();
    if (remainder < 1e-8) continue;
    basis.conservativeResize(columns.rows(), basis.cols() + 1);
    basis.rightCols<1>() = v / remainder;
    VectorXd again = basis.rightCols<1>();
    again -=
        basis.leftCols(basis.cols() - 1) * (basis.leftCols(basis.cols() - 1).transpose() * again);
    basis.rightCols<1>() = again.normalized();
  }
}

std::optional<MatrixXd> dense_space(const SkewOperator& op, Index pairs) {
  MatrixXd W(op.rows(), op.rows());
  for (Index j = 0; j < op.rows(); ++j) W.col(j) = op.apply(VectorXd::Unit(op.rows(), j));
  const SymmetricEigenpairs<MatrixXd> squared = symmetric_eigenpairs<MatrixXd>(W.transpose() * W);
  if (!squared.converged) return std::nullopt;
  const double largest = squared.value.tail(1)[0];
  Index kept = std::min<Index>(2 * pairs, op.rows());
  while (kept > 0 && !(squared.value[op.rows() - kept] > 1e-22 * largest)) --kept;
  return MatrixXd(squared.vector.rightCols(kept));
}

MatrixXd lanczos_space(const SkewOperator& op, Index pairs) {
  const Index dimension = op.rows() - op.known.cols();
  const Index wanted = std::min(2 * pairs, dimension - 1);
  if (wanted < 1) return MatrixXd(op.rows(), 0);
  return largest_eigenpairs([&op](const auto& z) { return op.apply_squared(z); },
                            op.complement(start_vectors(op.rows(), 1, op.known.cols())),
                            {wanted, std::min(dimension, 2 * wanted + 20), 1e-11})
      .vector;
}

/// Rayleigh functional of a shape: the positive root of m w^2 - c w - k = 0.
double frequency_of(const GyroscopicPencil& pencil, const VectorXcd& x) {
  const VectorXd a = x.real();
  const VectorXd b = x.imag();
  const double k = pencil.K_energy(a) + pencil.K_energy(b);
  const double m = a.dot(pencil.M * a) + b.dot(pencil.M * b);
  const double c = -2 * a.dot(pencil.C * b);
  return (c + std::sqrt(c * c + 4 * m * k)) / (2 * m);
}

/// Ritz vectors of i W in a space closed under W, frequencies ascending; false where they did not
/// converge.
bool ritz(const GyroscopicPencil& pencil, const SkewOperator& op, GyroscopicModes& modes) {
  const MatrixXd& V = op.known;
  MatrixXd WV(V.rows(), V.cols());
  for (Index j = 0; j < V.cols(); ++j) WV.col(j) = op.apply(V.col(j));
  const MatrixXd S = V.transpose() * WV;
  const MatrixXcd H = Complex(0, 0.5) * (S - S.transpose());
  const SymmetricEigenpairs<MatrixXcd> pairs = symmetric_eigenpairs(H);
  if (!pairs.converged) return false;
  const VectorXd& mu = pairs.value;  // ascending, in pairs +-
  const double smallest = 1e-11 * (mu.size() > 0 ? mu.tail(1)[0] : 0.0);
  const Index kept = (mu.array() > smallest).count();
  modes.omega.resize(kept);
  modes.shape.resize(pencil.K.rows(), kept);
  for (Index j = 0; j < kept; ++j) {
    const VectorXcd z = V * pairs.vector.col(mu.size() - 1 - j);
    VectorXcd x(pencil.K.rows());
    x.real() = op.displacement(z.real());
    x.imag() = op.displacement(z.imag());
    modes.shape.col(j) = x.normalized();
    modes.omega[j] = frequency_of(pencil, modes.shape.col(j));
  }
  return true;
}

/// A shift between two clearly different frequencies at or behind the wanted ones.
struct SeparatingShift {
  Index found;
  double omega;
};

SeparatingShift choose_separating_shift(const VectorXd& omega, Index count) {
  const Index p = omega.size();
  if (p == 0) return {0, 0};
  for (Index k = std::min(count, p); k < p; ++k) {
    if (omega[k] - omega[k - 1] > 1e-4 * omega[k]) return {k, (omega[k] + omega[k - 1]) / 2};
  }
  return {p, omega[p - 1] * (1 + 1e-6)};
}

GyroscopicModes no_modes(const Outcome& outcome) {
  GyroscopicModes modes;
  modes.outcome = outcome;
  return modes;
}

GyroscopicModes did_not_converge() {
  return no_modes({Status::not_converged, "the dense eigenvalue iteration did not converge"});
}

void truncate(GyroscopicModes& modes, Index count) {
  const Index kept = std::min(count, modes.omega.size());
  modes.omega.conservativeResize(kept);
  modes.shape.conservativeResize(Eigen::NoChange, kept);
  modes.growth_rate.setZero(kept);
}

}  // namespace

Index gyroscopic_sturm_count(const GyroscopicPencil& pencil, double omega) {
  using ComplexMatrix = Eigen::SparseMatrix<Complex>;
  const ComplexMatrix H = (pencil.K - omega * omega * pencil.M).cast<Complex>() +
                          Complex(0, omega) * pencil.C.cast<Complex>();
  return negative_pivots(H);
}

GyroscopicModes stable_gyroscopic_modes(const GyroscopicPencil& pencil, const Factorization& K,
                                        Index count, EigenMethod method, Counters& counters) {
  constexpr Index kDenseSize = 150;
  constexpr int kRounds = 20;
  const std::optional<SparseMatrix> R = mass_square_root(pencil.M);
  if (!R) return no_modes({Status::singular, "the mass matrix has no square root"});
  SkewOperator op(pencil, *R, K, counters);
  const bool dense = method == EigenMethod::dense || op.rows() < 12 ||
                     (method == EigenMethod::automatic && pencil.K.rows() <= kDenseSize);
  GyroscopicModes modes;
  op.known.resize(op.rows(), 0);
  Index wanted = count + 2;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<MatrixXd> space =
        dense ? dense_space(op, wanted) : std::optional(lanczos_space(op, wanted));
    if (!space) return did_not_converge();
    MatrixXd& found = *space;
    if (dense) op.known.resize(op.rows(), 0);
    const Index before = op.known.cols();
    extend(op.known, found);
    for (Index j = 0; j < found.cols(); ++j) found.col(j) = op.apply(found.col(j));
    extend(op.known, found);  // its partner, W times it
    if (!ritz(pencil, op, modes)) return did_not_converge();
    const SeparatingShift shift = choose_separating_shift(modes.omega, count);
    if (shift.found == 0) return no_modes({Status::not_converged, "no frequency is a number"});
    modes.inertia_count = gyroscopic_sturm_count(pencil, shift.omega);
    ++counters.factorizations;
    if (modes.inertia_count == shift.found) break;
    if (op.known.cols() == before || round + 1 == kRounds || modes.inertia_count < shift.found) {
      modes.outcome = {Status::not_converged, std::to_string(shift.found) +
                                                  " frequencies were found where the inertia of " +
                                                  "the matrices counts " +
                                                  std::to_string(modes.inertia_count)};
      break;
    }
    wanted = dense ? 2 * wanted : modes.inertia_count - shift.found + 1;
  }
  truncate(modes, count);
  return modes;
}

GyroscopicModes all_gyroscopic_modes(const GyroscopicPencil& pencil) {
  // mu^2 K + mu C + M = 0 with mu = 1 / lambda, in coordinates scaled to a unit diagonal of |K|.
  GyroscopicModes modes;
  const Index n = pencil.K.rows();
  const VectorXd scale = pencil.K.diagonal().cwiseAbs().unaryExpr(
      [](double d) { return d > 0 ? 1 / std::sqrt(d) : 1; });
  const auto scaled = [&scale](const SparseMatrix& A) -> MatrixXd {
    return scale.asDiagonal() * MatrixXd(A) * scale.asDiagonal();
  };
  MatrixXd C = scaled(pencil.C);
  MatrixXd M = scaled(pencil.M);
  const double time = std::sqrt(M.norm() / static_cast<double>(n));  // lambda in units of 1 / time
  if (!(time > 0)) return modes;
  C /= time;
  M /= time * time;
  const DenseLu lu(scaled(pencil.K));
  MatrixXd companion(2 * n, 2 * n);
  companion << -lu.solve(C), -lu.solve(M), MatrixXd::Identity(n, n), MatrixXd::Zero(n, n);
  const ComplexEigenpairs pairs = eigenpairs(companion);
  if (!pairs.converged) return did_not_converge();
  struct Root {
    double omega, growth_rate;
    Index column;
  };
  std::vector<Root> roots;
  const double largest = pairs.value.cwiseAbs().maxCoeff();
  for (Index j = 0; j < 2 * n; ++j) {
    const Complex mu = pairs.value[j];
    if (std::abs(mu) < 1e-9 * largest) continue;  // without mass
    Complex lambda = 1.0 / (mu * time);
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
    const VectorXcd x = scale.asDiagonal() * pairs.vector.col(root.column).head(n);
    modes.shape.col(j) = x.normalized();
  }
  return modes;
}

}  // namespace trammel::solver
