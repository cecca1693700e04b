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

/// Row by row, K (x, y) = (M x / mu, 0) for the real or the imaginary part of a mode.
double residual_of(const KktMatrix& K, const VectorXd& mode, const VectorXd& inertia) {
  VectorXd residual(mode.size()), terms(mode.size());
  K.multiply(mode, residual);
  K.term_magnitudes(mode.cwiseAbs(), terms);
  residual.head(inertia.size()) -= inertia;
  terms.head(inertia.size()) += inertia.cwiseAbs();
  return largest_ratio(residual, terms.array() + terms.maxCoeff() * 1e-9);
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
  MatrixXd flexibility = MatrixXd::Zero(n + m, n);  // K^-1 (M, 0)
  flexibility.topRows(n) = M;
  for (Index j = 0; j < n; ++j) K.solve(flexibility.col(j));
  // Coordinates over their scale, so that no unit of length enters.
  const VectorXd& scale = system.scale();
  const ComplexEigenpairs pairs =
      eigenpairs(scale.cwiseInverse().asDiagonal() * flexibility.topRows(n) * scale.asDiagonal());
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
    const VectorXcd mode = flexibility * x / mu, inertia = M * x / mu;
    found.evidence.add(Residual::eigenvalue_equation,
                       std::max(residual_of(K, mode.real(), inertia.real()),
                                mu.imag() == 0 ? 0 : residual_of(K, mode.imag(), inertia.imag())));
  }
  found.outcome = outcome_by_evidence(found.outcome, found.evidence);
  return found;
}

}  // namespace trammel::solver::large_motion
