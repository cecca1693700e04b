#include "solver/large_motion/solve/small_vibration.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "solver/linalg/backward_error.h"
#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// Below this share of |s| its real or imaginary part is round-off.
constexpr double kRoundoffShare = 1e-7;
/// Where w^2 of some modes is below this share of that of the next, K^-1 has few digits of the
/// others.
constexpr double kSoftShare = 1e-10;
/// The lowest w^2 above them is known in K^-1 to some orders of magnitude; of what has no mass, to
/// none.
constexpr double kAlike = 1e6;
/// A motion is free where all that K makes of it is the rounding of a row's terms.
constexpr double kFreeRow = 1e3 * kEps;
/// How far from a mode's w^2 the matrix is factored that its vector is solved for with.
constexpr double kAside = 1e-3;

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

/// Row by row, K (x, y) = (w^2 M x, 0) for the real or the imaginary part of a mode; a coordinate
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

/// Factors K - w2 M.
bool factor(const GeometricallyExactSystem& system, const State& state, double w2, KktMatrix& K) {
  TangentCoefficients coefficients;
  coefficients.mass = -w2;
  K.clear();
  system.tangent(state, coefficients, K);
  return K.factor(system.symmetric());
}

/// The modes by their |w^2|, ascending.
struct Spectrum {
  bool converged = false;
  std::vector<std::complex<double>> w2;  // infinite of what has no mass
  std::vector<VectorXcd> x;
  double shift = 0;
};

/// @param K  has K - shift M factored
Spectrum spectrum(const KktMatrix& K, Index constraints, const MatrixXd& M, const VectorXd& scale,
                  double shift) {
  const Index n = M.rows();
  MatrixXd flexibility(n, n);  // of K^-1 (M, 0)
  for (Index j = 0; j < n; ++j)
    flexibility.col(j) = refined_solve(K, n + constraints, M.col(j)).head(n);
  // Coordinates over their scale, so that no unit of length enters.
  const ComplexEigenpairs pairs =
      eigenpairs(scale.cwiseInverse().asDiagonal() * flexibility * scale.asDiagonal());
  Spectrum found;
  found.converged = pairs.converged;
  found.shift = shift;
  if (!pairs.converged) return found;
  const auto inverse = [&](Index j) {  // 1 / |w^2|
    return std::abs(pairs.value[j]) / std::abs(1.0 + shift * pairs.value[j]);
  };
  std::vector<Index> order(to_size(n));
  for (Index j = 0; j < n; ++j) order[to_size(j)] = j;
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return inverse(a) > inverse(b); });
  for (const Index j : order) {
    found.w2.push_back(shift + 1.0 / pairs.value[j]);
    found.x.emplace_back(scale.asDiagonal() * pairs.vector.col(j));
  }
  return found;
}

/// w^2 of the lowest mode above those that are free or nearly so, 0 where none is.
double lowest_above_soft(const Spectrum& modes) {
  for (std::size_t k = 1; k < modes.w2.size(); ++k) {
    const double above = std::abs(modes.w2[k]);
    if (std::abs(modes.w2[k - 1]) < kSoftShare * above) return above;
  }
  return 0;
}

/// One inverse iteration with K - t M factored beside a real w^2, and w^2 by it. The whole matrix
/// has the rounding of its lowest mode, and K^-1 leaves more of that in a higher one, by the ratio
/// of both; here the higher one is the largest.
VectorXd beside(const GeometricallyExactSystem& system, const State& state, const MatrixXd& M,
                std::complex<double>& w2, const VectorXd& mode) {
  const Index n = system.coordinates(), m = system.constraints();
  const double t = w2.real() - kAside * std::abs(w2);
  KktMatrix K(n, m, system.blocks());
  if (!factor(system, state, t, K)) return mode;
  const VectorXd inertia = M * mode.head(n);
  const VectorXd next = refined_solve(K, n + m, inertia);
  const double mass = next.head(n).dot(M * next.head(n));
  w2 = t + next.head(n).dot(inertia) / mass;
  return next / std::sqrt(mass);
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
  auto shifted = std::make_unique<KktMatrix>(n, m, system.blocks());
  if (!factor(system, state, 0, *shifted)) {
    found.outcome = {Status::singular, "the tangent is singular"};
    return found;
  }
  const MatrixXd M = mass_matrix(system, state);
  const VectorXd& scale = system.scale();
  Spectrum modes = spectrum(*shifted, m, M, scale, 0);
  if (const double above = lowest_above_soft(modes); above > 0) {
    auto stiffened = std::make_unique<KktMatrix>(n, m, system.blocks());
    if (factor(system, state, -above, *stiffened)) {
      Spectrum clear = spectrum(*stiffened, m, M, scale, -above);
      // Else all that it is soft beside is without mass.
      if (lowest_above_soft(clear) > 0 && lowest_above_soft(clear) < kAlike * above) {
        modes = std::move(clear);
        shifted = std::move(stiffened);
      }
    }
  }
  if (!modes.converged) {
    found.outcome = {Status::not_converged, "the eigenvalues of the dense matrix"};
    return found;
  }
  count = std::min(count, n);
  found.frequency.resize(count);
  found.growth_rate.resize(count);
  for (Index k = 0; k < count; ++k) {
    std::complex<double> w2 = modes.w2[to_size(k)];
    const VectorXcd force = (w2 - modes.shift) * (M * modes.x[to_size(k)]);
    VectorXcd mode = refined_solve(*shifted, n + m, force.real());
    if (std::abs(w2) < kSoftShare * std::abs(modes.shift) &&
        residual_of(K, scale, mode.real(), VectorXd::Zero(n)) < kFreeRow) {
      w2 = 0;
    } else if (w2.imag() != 0) {
      mode += std::complex<double>(0, 1) * refined_solve(*shifted, n + m, force.imag());
    } else {
      mode = beside(system, state, M, w2, mode.real());
    }
    std::complex<double> s = std::sqrt(-w2);
    if (std::abs(s.real()) < kRoundoffShare * std::abs(s)) s.real(0);
    if (std::abs(s.imag()) < kRoundoffShare * std::abs(s)) s.imag(0);
    found.frequency[k] = std::abs(s.imag()) / (2 * std::numbers::pi);
    found.growth_rate[k] = std::abs(s.real());
    const VectorXcd inertia = w2 * (M * mode.head(n));
    found.evidence.add(
        Residual::eigenvalue_equation,
        std::max(residual_of(K, scale, mode.real(), inertia.real()),
                 w2.imag() == 0 ? 0 : residual_of(K, scale, mode.imag(), inertia.imag())));
  }
  found.outcome = outcome_by_evidence(found.outcome, found.evidence);
  return found;
}

}  // namespace trammel::solver::large_motion
