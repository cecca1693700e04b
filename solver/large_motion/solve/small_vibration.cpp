#include "solver/large_motion/solve/small_vibration.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "solver/linalg/backward_error.h"
#include "solver/linalg/dense_eigen.h"

namespace trammel::solver::large_motion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Below this share of |s| its real or imaginary part is round-off.
constexpr double kRoundoffShare = 1e-7;

/// M, as what accelerations add to the forces of a state at rest.
MatrixXd mass_matrix(const ConstrainedSystem& system, const State& at_rest) {
  const Index n = system.coordinates();
  State state = at_rest;
  VectorXd still(n), moved(n);
  MatrixXd M(n, n);
  state.v.setZero();
  state.a.setZero();
  system.force_residual(state, still);
  for (Index j = 0; j < n; ++j) {
    state.a[j] = 1;
    system.force_residual(state, moved);
    M.col(j) = moved - still;
    state.a[j] = 0;
  }
  return M;
}

/// Row by row, K (x, y) = (M x / mu, 0) for the real or the imaginary part of a mode; a coordinate
/// counts with at least a thousandth of the largest motion, as in equation_rows.h.
double residual_of(const KktMatrix& K, const VectorXd& scale, const VectorXd& mode,
                   const VectorXd& inertia) {
  VectorXd residual(mode.size()), terms(mode.size()), size = mode.cwiseAbs();
  K.multiply(mode, residual);
  auto motion = size.head(scale.size());
  motion = motion.cwiseMax(kLeastShare * motion.cwiseQuotient(scale).maxCoeff() * scale);
  K.term_magnitudes(size, terms);
  residual.head(inertia.size()) -= inertia;
  terms.head(inertia.size()) += inertia.cwiseAbs();
  return largest_ratio(residual, terms.array() + terms.maxCoeff() * 1e-9);
}

/// K^-1 (f, 0), and what rounding leaves of the rows solved for again.
VectorXd refined_solve(const KktMatrix& K, Index size, const VectorXd& force) {
  VectorXd x = VectorXd::Zero(size), product(size);
  for (int pass = 0; pass < 3; ++pass) {
    K.multiply(x, product);
    VectorXd correction = -product;
    correction.head(force.size()) += force;
    K.solve(correction);
    x += correction;
  }
  return x;
}

}  // namespace

SmallVibration small_vibration(const GeometricallyExactSystem& system, const State& state,
                               Index count) {
  const Index n = system.coordinates(), m = system.constraints();
  if (n > kMaxVibrationCoordinates)
    throw ModelError("small vibration about a large displacement takes at most " +
                     std::to_string(kMaxVibrationCoordinates) + " coordinates; the model has " +
                     std::to_string(n));
  SmallVibration found;
  KktMatrix K(n, m, system.blocks());
  K.clear();
  system.tangent(state, TangentCoefficients{}, K);
  if (!K.factor(system.symmetric())) {
    found.outcome = {Status::singular, "the tangent is singular"};
    return found;
  }
  const MatrixXd M = mass_matrix(system, state);
  MatrixXd flexibility(n, n);  // of K^-1 (M, 0)
  for (Index j = 0; j < n; ++j) flexibility.col(j) = refined_solve(K, n + m, M.col(j)).head(n);
  // Coordinates over their scale, so that no unit of length enters.
  const VectorXd& scale = system.scale();
  const ComplexEigenpairs pairs =
      eigenpairs(scale.cwiseInverse().asDiagonal() * flexibility * scale.asDiagonal());
  if (!pairs.converged) {
    found.outcome = {Status::not_converged, "the eigenvalues of the dense matrix"};
    return found;
  }
  std::vector<Index> order(to_size(n));
  for (Index j = 0; j < n; ++j) order[to_size(j)] = j;
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
    return std::abs(pairs.value[a]) > std::abs(pairs.value[b]);
  });
  count = std::min(count, n);
  found.frequency.resize(count);
  found.growth_rate.resize(count);
  for (Index k = 0; k < count; ++k) {
    const std::complex<double> mu = pairs.value[order[to_size(k)]];
    std::complex<double> s = std::sqrt(-1.0 / mu);
    if (std::abs(s.real()) < kRoundoffShare * std::abs(s)) s.real(0);
    if (std::abs(s.imag()) < kRoundoffShare * std::abs(s)) s.imag(0);
    found.frequency[k] = std::abs(s.imag()) / (2 * std::numbers::pi);
    found.growth_rate[k] = std::abs(s.real());
    const VectorXcd x = scale.asDiagonal() * pairs.vector.col(order[to_size(k)]);
    const VectorXcd force = M * x / mu;
    VectorXcd mode = refined_solve(K, n + m, force.real());
    if (mu.imag() != 0) mode += std::complex<double>(0, 1) * refined_solve(K, n + m, force.imag());
    const VectorXcd inertia = M * mode.head(n) / mu;
    found.evidence.add(
        Residual::eigenvalue_equation,
        std::max(residual_of(K, scale, mode.real(), inertia.real()),
                 mu.imag() == 0 ? 0 : residual_of(K, scale, mode.imag(), inertia.imag())));
  }
  found.outcome = outcome_by_evidence(found.outcome, found.evidence);
  return found;
}

}  // namespace trammel::solver::large_motion
