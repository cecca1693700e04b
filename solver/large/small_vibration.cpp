#include "solver/large/small_vibration.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "solver/linalg/dense_eigen.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Extended = KktMatrix::Extended;

/// Fraction of |s| below which the real or imaginary part of the exponent s of a mode q e^{s t} is
/// treated as round-off error.
constexpr double kRoundoffShare = 1e-7;
/// Ratio of the squared frequencies w^2 of two successive modes below which the lower modes are
/// called soft. The computed K^-1 then has few correct digits of the higher modes.
constexpr double kSoftShare = 1e-10;
/// Largest ratio of two estimates of the lowest w^2 above the soft modes: from K^-1 and from a
/// shifted K. A larger ratio shows that all motions stiffer than the soft modes are massless.
constexpr double kAlike = 1e6;
/// Relative distance of the shift from w^2 of a mode in the inverse iteration.
constexpr double kAside = 1e-3;

/// Matrix [K - w2 M, G^T; G, -C] with the squared frequency w2 as shift. M is the mass matrix, G
/// the constraint gradient, and C the compliances. The matrix is factored with penalties, and
/// assembled again without penalties for exact products. Otherwise, round-off errors of stiff
/// members would hide the stiffness of soft joints.
class ShiftedStiffness {
 public:
  ShiftedStiffness(const GeometricallyExactSystem& system, const State& state, double w2)
      : system_(system),
        plain_(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns()),
        factored_(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns()) {
    TangentCoefficients coefficients;
    coefficients.mass = -w2;
    factored_.clear();
    system.add_tangent(state, coefficients, factored_);
    exists_ = factored_.factor(system.has_symmetric_tangent());
    coefficients.has_penalty = false;
    plain_.clear();
    system.add_tangent(state, coefficients, plain_);
  }

  /// Returns false if the shifted stiffness matrix is singular.
  [[nodiscard]] bool is_nonsingular() const { return exists_; }

  /// Solves K (x, y) = (f, 0) for motions x and constraint forces y by iterative refinement.
  [[nodiscard]] Extended solve(const Extended& force) const {
    constexpr double kEnough = 1e-13;
    constexpr int kPasses = 30;  // corrections of ill-conditioned matrices do not decrease evenly
    const Index n = system_.coordinate_count();
    Extended x = Extended::Zero(n + system_.constraint_count());
    last_correction_ = 1;
    for (int pass = 0; pass < kPasses; ++pass) {
      Extended residual = -plain_.multiply(x);
      residual.head(n) += force;
      VectorXd correction = residual.cast<double>();
      factored_.solve(correction);
      x += correction.cast<long double>();
      // The refinement measures corrections of motions relative to the motions. Corrections of
      // constraint forces are relative to all forces, including the forces on the coordinates.
      const auto size_of = [&](const VectorXd& values, const VectorXd& unit, Index begin) {
        return values.segment(begin, unit.size()).cwiseProduct(unit).norm();
      };
      const VectorXd now = x.cast<double>(), unit = system_.scale().cwiseInverse();
      const double motion = size_of(now, unit, 0);
      const double forces =
          size_of(now, system_.row_units(), n) + size_of(force.cast<double>(), system_.scale(), 0);
      const double share =
          std::max(motion > 0 ? size_of(correction, unit, 0) / motion : 0,
                   forces > 0 ? size_of(correction, system_.row_units(), n) / forces : 0);
      const bool stalled = pass > 1 && !(share < 0.5 * last_correction_);
      last_correction_ = share;
      if (share < kEps || (stalled && share < kEnough)) break;
    }
    return x;
  }

  /// Returns true if the last result of `solve` is accurate to six digits.
  [[nodiscard]] bool converged() const { return last_correction_ < 1e-6; }

  /// Returns the backward error of K (x, y) = (w^2 M x, 0) for the real or the imaginary part of a
  /// mode, row by row. In the sum of magnitudes of a row, each coordinate is at least
  /// `kLeastFraction` of the largest motion. The terms of each row are at least 1e-9 of the largest
  /// terms of rows of the same type (forces or constraints).
  [[nodiscard]] double residual(const Extended& mode, const Extended& inertia) const {
    constexpr double kLeastRow = 1e-9;
    const VectorXd& scale = system_.scale();
    const Index n = scale.size();
    Extended residual = plain_.multiply(mode);
    VectorXd terms(mode.size()), size = mode.cast<double>().cwiseAbs();
    auto motion = size.head(n);
    motion = motion.cwiseMax(kLeastFraction * motion.cwiseQuotient(scale).maxCoeff() * scale);
    plain_.term_magnitudes(size, terms);
    residual.head(n) -= inertia;
    terms.head(n) += inertia.cast<double>().cwiseAbs();
    VectorXd unit(mode.size());  // units of forces and of residuals of constraints
    unit << scale.cwiseInverse(), system_.row_units();
    for (const auto& [begin, count] : {std::pair(Index{0}, n), std::pair(n, mode.size() - n)}) {
      if (count == 0) continue;
      auto kind = terms.segment(begin, count);
      const auto own = unit.segment(begin, count);
      kind += kLeastRow * kind.cwiseQuotient(own).maxCoeff() * own;
    }
    return row_backward_error(residual.cast<double>(), terms);
  }

  /// Returns the energy of a mode divided by the round-off error of this energy (see `KktMatrix`).
  [[nodiscard]] double energy_over_roundoff(const Extended& mode) const {
    return plain_.energy_over_roundoff(mode);
  }

 private:
  const GeometricallyExactSystem& system_;
  KktMatrix plain_, factored_;
  bool exists_ = false;
  mutable double last_correction_ = 1;
};

/// Returns the factor L of the mass matrix M = L L^T, with one column for each motion that has
/// mass. Massless coordinates have no mode and would cause eigenvalues that are round-off errors.
MatrixXd mass_matrix_factor(const MatrixXd& M) {
  const VectorXd size = M.diagonal().cwiseMax(0).cwiseSqrt();
  const VectorXd inverse = size.unaryExpr([](double x) { return x > 0 ? 1 / x : 0.0; });
  const auto pairs = symmetric_eigenpairs((inverse.asDiagonal() * M * inverse.asDiagonal()).eval());
  const double rounding = static_cast<double>(M.rows()) * kEps;  // for a matrix with unit diagonal
  const Index rank = (pairs.value.array() > rounding).count();
  return size.asDiagonal() * pairs.vector.rightCols(rank) *
         pairs.value.tail(rank).cwiseSqrt().asDiagonal();
}

/// Modes in ascending order of |w^2|.
struct Spectrum {
  bool converged = false;
  std::vector<std::complex<double>> w2;  // squared frequencies [rad^2/s^2]
  std::vector<VectorXcd> x;
  double shift = 0;
};

/// Computes all modes from the inverse of the matrix K with the given shift, and from the factor L
/// of the mass matrix.
Spectrum spectrum(const ShiftedStiffness& K, const MatrixXd& L, double shift, bool symmetric) {
  const Index n = L.rows();
  MatrixXd flexibility(n, L.cols());  // (K - shift M)^-1 (L, 0)
  for (Index j = 0; j < L.cols(); ++j)
    flexibility.col(j) = K.solve(L.col(j).cast<long double>()).head(n).cast<double>();
  const MatrixXd A = L.transpose() * flexibility;
  ComplexEigenpairs pairs;
  if (symmetric) {
    const SymmetricEigenpairs real = symmetric_eigenpairs((0.5 * (A + A.transpose())).eval());
    pairs = {real.converged, real.value, real.vector};
  } else {
    pairs = eigenpairs(A);
  }
  Spectrum found;
  found.converged = pairs.converged;
  found.shift = shift;
  if (!pairs.converged) return found;
  // Motions that the constraints prevent have eigenvalues of round-off size and no mode.
  const double held = 1e-4 * kEps * pairs.value.cwiseAbs().maxCoeff();
  std::vector<std::pair<std::complex<double>, Index>> order;  // w^2 and column of each mode
  for (Index j = 0; j < pairs.value.size(); ++j)
    if (std::abs(pairs.value[j]) > held) order.emplace_back(shift + 1.0 / pairs.value[j], j);
  std::ranges::stable_sort(order, {}, [](const auto& mode) { return std::abs(mode.first); });
  for (const auto& [w2, j] : order) {
    found.w2.push_back(w2);
    found.x.emplace_back(flexibility * pairs.vector.col(j));
  }
  return found;
}

/// Returns w^2 of the lowest mode above the free and the soft modes (see kSoftShare), or 0 if there
/// is none.
double lowest_above_soft_modes(const Spectrum& modes) {
  for (std::size_t k = 1; k < modes.w2.size(); ++k) {
    const double above = std::abs(modes.w2[k]);
    if (std::abs(modes.w2[k - 1]) < kSoftShare * above) return above;
  }
  return 0;
}

/// Returns w^2 of the lowest mode that is not a free motion, for a K that is singular to working
/// precision. All modes that follow from the inverse of such a K contain components of the free
/// motions. K is therefore shifted by multiples of M. The shifts start above all modes and decrease
/// to the lowest mode that is not free.
double lowest_above_free_motions(const GeometricallyExactSystem& system, const State& state,
                                 const MatrixXd& L, const Spectrum& mixed) {
  constexpr double kNear = 1e-4;  // least w^2 / shift for ten correct digits of w^2
  double shift = mixed.w2.empty() ? 0 : std::abs(mixed.w2.back());
  for (int pass = 0; pass < 8 && shift > 0; ++pass) {
    const ShiftedStiffness K(system, state, -shift);
    if (!K.is_nonsingular()) return 0;
    double lowest = 0;
    for (const auto w2 : spectrum(K, L, -shift, system.has_symmetric_tangent()).w2) {
      const double size = std::abs(w2);
      if (size > kSoftShare * shift && (lowest == 0 || size < lowest)) lowest = size;
    }
    if (lowest > kNear * shift) return lowest;
    shift = lowest;
  }
  return 0;
}

/// Improves a real mode and its w^2 by inverse iteration with K - t M, where the shift t is next to
/// w^2. The matrix from which all modes follow has round-off errors relative to its lowest mode.
/// These errors contaminate a higher mode in proportion to the ratio of its w^2 to the w^2 of the
/// lowest mode. With the shift, the requested mode dominates.
Extended beside(const GeometricallyExactSystem& system, const State& state, const MatrixXd& M,
                std::complex<double>& w2, Extended mode) {
  const Index n = system.coordinate_count();
  // Increase the distance between shift and w^2 if round-off errors of the factors exceed this
  // distance.
  for (const double aside : {kAside, 0.03, 0.3}) {
    const double t = w2.real() - aside * std::abs(w2);
    const ShiftedStiffness K(system, state, t);
    if (!K.is_nonsingular()) continue;
    // Each pass reduces other modes by the factor `aside`.
    const int passes = aside == kAside ? 4 : 20;
    for (int pass = 0; pass < passes; ++pass) {
      const Extended inertia = M.cast<long double>() * mode.head(n);
      const Extended next = K.solve(inertia);
      if (!K.converged()) break;
      const long double mass = next.head(n).dot(M.cast<long double>() * next.head(n));
      w2 = static_cast<double>(t + next.head(n).dot(inertia) / mass);
      mode = next / std::sqrt(mass);
    }
    if (K.converged()) break;
  }
  return mode;
}

}  // namespace

SmallVibration small_vibration(const GeometricallyExactSystem& system, const State& state,
                               Index count) {
  const Index n = system.coordinate_count();
  if (n > kMaxVibrationCoordinates)
    throw ModelError("small vibration about a large displacement supports at most " +
                     std::to_string(kMaxVibrationCoordinates) + " coordinates; the model has " +
                     std::to_string(n));
  SmallVibration found;
  const ShiftedStiffness K(system, state, 0);
  if (!K.is_nonsingular()) {
    found.outcome = {Status::singular, "the tangent matrix is singular"};
    return found;
  }
  const MatrixXd M = MatrixXd(system.mass()).topLeftCorner(n, n), L = mass_matrix_factor(M);
  if (L.cols() == 0) {
    found.outcome = {Status::singular, "nothing vibrates: no movable coordinate has a mass"};
    return found;
  }
  Spectrum modes = spectrum(K, L, 0, system.has_symmetric_tangent());
  std::optional<ShiftedStiffness> stiffened;
  double above = 0;
  if (!modes.x.empty()) {
    const Extended lowest = K.solve((M * modes.x.front().real()).cast<long double>());
    above = K.energy_over_roundoff(lowest) <= 1 ? lowest_above_free_motions(system, state, L, modes)
                                                : lowest_above_soft_modes(modes);
  }
  if (above > 0) {
    stiffened.emplace(system, state, -above);
    const Spectrum clear = stiffened->is_nonsingular()
                               ? spectrum(*stiffened, L, -above, system.has_symmetric_tangent())
                               : Spectrum();
    // `above` and `next` are two estimates of w^2 of the lowest mode above the soft modes. `next`
    // follows from K with the shift -above. If the estimates differ by more than the factor kAlike,
    // all motions stiffer than the soft modes are massless.
    const double next = lowest_above_soft_modes(clear);
    if (next > above / kAlike && next < kAlike * above) {
      modes = clear;
    } else {
      stiffened.reset();
    }
  }
  const ShiftedStiffness& shifted = stiffened ? *stiffened : K;
  if (!modes.converged) {
    found.outcome = {Status::not_converged, "the eigenvalues of the dense matrix did not converge"};
    return found;
  }
  count = std::min(count, std::ssize(modes.w2));
  found.frequency.resize(count);
  found.growth_rate.resize(count);
  found.roundoff.setZero(count);
  for (Index k = 0; k < count; ++k) {
    std::complex<double> w2 = modes.w2[to_size(k)];
    const VectorXcd force = (w2 - modes.shift) * (M * modes.x[to_size(k)]);
    Extended mode = shifted.solve(force.real().cast<long double>());
    Extended imaginary = Extended::Zero(mode.size());
    const bool is_soft = std::abs(w2) < kSoftShare * std::abs(modes.shift);
    for (int pass = 0; is_soft && pass < 2; ++pass)
      mode = shifted.solve(-modes.shift * (M.cast<long double>() * mode.head(n)));
    if (is_soft && K.energy_over_roundoff(mode) <= 1) {
      w2 = 0;
    } else if (w2.imag() != 0) {
      imaginary = shifted.solve(force.imag().cast<long double>());
    } else {
      mode = beside(system, state, M, w2, mode);
    }
    std::complex<double> s = std::sqrt(-w2);
    if (std::abs(s.real()) < kRoundoffShare * std::abs(s)) s.real(0);
    if (std::abs(s.imag()) < kRoundoffShare * std::abs(s)) s.imag(0);
    found.frequency[k] = std::abs(s.imag()) / (2 * std::numbers::pi);
    found.growth_rate[k] = std::abs(s.real());
    if (w2 == 0.0) {
      found.evidence.add(Residual::eigenvalue_equation, kEps * K.energy_over_roundoff(mode));
      continue;
    }
    // The factor 0.5 converts the relative error of the energy to that of the frequency, which is
    // proportional to the square root of the energy.
    if (w2.imag() == 0) found.roundoff[k] = 0.5 / K.energy_over_roundoff(mode);
    const Extended real = M.cast<long double>() * mode.head(n);
    const Extended other = M.cast<long double>() * imaginary.head(n);
    const long double a = w2.real(), b = w2.imag();
    found.evidence.add(Residual::eigenvalue_equation,
                       std::max(K.residual(mode, a * real - b * other),
                                w2.imag() == 0 ? 0 : K.residual(imaginary, a * other + b * real)));
  }
  found.outcome = outcome_by_evidence(found.outcome, found.evidence);
  return found;
}

}  // namespace trammel::solver::large_motion
