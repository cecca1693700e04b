#include "solver/motion/modal_superposition.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/factorization.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

/// Values and slopes of the load factors at the start of a time interval.
struct Factor {
  VectorXd value, slope;
};

/// Iterates over the intervals between all sample times and load times in ascending order. Calls
/// `sample` with the index of a sample and the load factors of the interval that starts at the
/// sample. Calls `advance` with the length [s] and the load factors of each interval.
template <class Sample, class Advance>
void walk(const PiecewiseLinearLoad& load, const std::vector<double>& times, const Sample& sample,
          const Advance& advance) {
  std::vector<double> stops = times;
  std::copy_if(load.time.begin(), load.time.end(), std::back_inserter(stops),
               [&](double t) { return t > times.front() && t < times.back(); });
  std::sort(stops.begin(), stops.end());
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  std::size_t next = 0;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const auto [left, right, share, length] = find_interval(load.time, stops[k]);
    Factor factor;
    factor.slope = (load.factor.col(right) - load.factor.col(left)) / length;
    factor.value = load.factor.col(left) + share * length * factor.slope;
    for (; next < times.size() && times[next] == stops[k]; ++next)
      sample(static_cast<Index>(next), factor);
    if (k + 1 < stops.size()) advance(stops[k + 1] - stops[k], factor);
  }
}

}  // namespace

ModalBasis all_modes(const SparseMatrix& M, const SparseMatrix& K) {
  const Eigen::MatrixXd mass = M;
  const Eigen::MatrixXd stiffness = K;
  const double trace = mass.trace();
  if (!(trace > 0)) throw ModelError("a model without mass has no vibration modes");
  // Solve M x = mu (K + s M) x with a shift s far below most eigenvalues w^2: mu = 1 / (w^2 + s).
  const double shift = 1e-4 * stiffness.trace() / trace;
  const double positive = shift > 0 ? shift : 1;
  const Eigen::MatrixXd shifted = stiffness + positive * mass;
  ModalBasis basis;
  if (!(shifted.diagonal().array() > 0).all()) {
    basis.outcome = {Status::singular, "a coordinate has neither stiffness nor mass"};
    return basis;
  }
  const SymmetricEigenpairs pairs = symmetric_eigenpairs(mass, shifted);
  if (!pairs.converged) {
    basis.outcome = {Status::not_converged, "the dense eigenvalue iteration did not converge"};
    return basis;
  }
  const VectorXd& mu = pairs.value;
  const double floor = 1e-13 * mu.maxCoeff();
  const Index count = (mu.array() > floor).count();
  basis.omega.resize(count);
  basis.shape.resize(M.rows(), count);
  for (Index i = 0; i < count; ++i) {
    const Index column = mu.size() - 1 - i;
    const VectorXd x = pairs.vector.col(column);
    const double modal_mass = x.dot(mass * x);
    basis.shape.col(i) = x / std::sqrt(modal_mass);
    basis.omega[i] = x.dot(stiffness * x) / modal_mass;
  }
  // Treat eigenvalues as zero if they are within the round-off error of the largest eigenvalue.
  const double zero = count == 0 ? 0 : 1e-15 * basis.omega.cwiseAbs().maxCoeff();
  for (double& w2 : basis.omega) w2 = w2 > zero ? std::sqrt(w2) : 0;
  return basis;
}

ModalResponse superpose(const ModalBasis& basis, const VectorXd& decay, const SparseMatrix& M,
                        const PiecewiseLinearLoad& load, const std::vector<double>& times,
                        const VectorXd& q0, const VectorXd& v0) {
  const Index modes = basis.omega.size();
  const auto columns = static_cast<Index>(times.size());
  const Eigen::MatrixXd pattern = basis.shape.transpose() * load.pattern;
  std::vector<OscillatorState> state(to_size(modes));
  const auto project = [&](const VectorXd& x) -> VectorXd {
    if (x.size() == 0) return VectorXd::Zero(modes);
    return basis.shape.transpose() * (M * x);
  };
  const VectorXd y0 = project(q0), w0 = project(v0);
  for (Index i = 0; i < modes; ++i) state[to_size(i)] = {y0[i], w0[i]};

  Eigen::MatrixXd y(modes, columns);
  Eigen::MatrixXd v(modes, columns);
  Eigen::MatrixXd a(modes, columns);
  VectorXd p0, p1;
  const auto sample = [&](Index column, const Factor& factor) {
    p0 = pattern * factor.value;
    for (Index i = 0; i < modes; ++i) {
      const OscillatorState& s = state[to_size(i)];
      const double w = basis.omega[i];
      y(i, column) = s.y;
      v(i, column) = s.v;
      a(i, column) = p0[i] - 2 * decay[i] * s.v - w * w * s.y;
    }
  };
  walk(load, times, sample, [&](double step, const Factor& factor) {
    p0 = pattern * factor.value;
    p1 = pattern * factor.slope;
    for (Index i = 0; i < modes; ++i) {
      OscillatorState& s = state[to_size(i)];
      const double w = basis.omega[i];
      s = advance(impulse_response(w, decay[i], step), w, s, p0[i], p1[i]);
    }
  });
  return {basis.shape * y, basis.shape * v, basis.shape * a};
}

DelayedFactors delayed_factors(const PiecewiseLinearLoad& load, double relaxation,
                               const VectorXd& start, const std::vector<double>& times) {
  DelayedFactors found;
  const auto columns = static_cast<Index>(times.size());
  for (Eigen::MatrixXd* m : {&found.value, &found.rate, &found.acceleration})
    m->setZero(load.factor.rows(), columns);
  VectorXd y = start, settled, away;
  const auto split = [&](const Factor& factor) {
    settled = factor.value - relaxation * factor.slope;
    away = relaxation > 0 ? VectorXd(y - settled) : VectorXd::Zero(y.size());
  };
  const auto sample = [&](Index column, const Factor& factor) {
    split(factor);
    found.value.col(column) = settled + away;
    found.rate.col(column) = factor.slope;
    if (relaxation == 0) return;
    // Compute the rate from the differential equation, which causes no round-off error at rest.
    found.rate.col(column) = (factor.value - found.value.col(column)) / relaxation;
    found.acceleration.col(column) = (factor.slope - found.rate.col(column)) / relaxation;
  };
  walk(load, times, sample, [&](double step, const Factor& factor) {
    if (relaxation == 0) return;
    split(factor);
    y = settled + step * factor.slope + std::exp(-step / relaxation) * away;
  });
  return found;
}

void add_massless_response(const ModalBasis& basis, const SparseMatrix& M, const SparseMatrix& K,
                           double relaxation, const PiecewiseLinearLoad& load,
                           const std::vector<double>& times, const VectorXd& q0,
                           ModalResponse& response, Counters& counters) {
  const auto beside_modes = [&](const VectorXd& x) -> VectorXd {
    return x - basis.shape * (basis.shape.transpose() * (M * x));
  };
  const Eigen::MatrixXd rest =
      load.pattern - M * (basis.shape * (basis.shape.transpose() * load.pattern));
  if (rest.norm() > 1e-9 * load.pattern.norm()) {
    // Add a multiple of M to K, because K is singular if there are rigid modes. This multiple does
    // not affect massless coordinates, because M x = 0.
    const double shift = K.diagonal().sum() / M.diagonal().sum();
    Factorization factorization;
    factorization.compute(SparseMatrix(K + shift * M));
    ++counters.factorizations;
    if (!factorization.is_nonsingular()) return;
    Eigen::MatrixXd held(rest.rows(), rest.cols());
    for (Index i = 0; i < rest.cols(); ++i)
      held.col(i) = beside_modes(factorization.solve(rest.col(i)));
    counters.solves += rest.cols();
    const auto followed = delayed_factors(load, relaxation, VectorXd::Zero(rest.cols()), times);
    response.q += held * followed.value;
    response.v += held * followed.rate;
    response.a += held * followed.acceleration;
  }
  if (q0.size() == 0 || relaxation == 0) return;
  const VectorXd start = beside_modes(q0);
  for (Index i = 0; i < response.q.cols(); ++i) {
    const double left = std::exp((times.front() - times[to_size(i)]) / relaxation);
    response.q.col(i) += left * start;
    response.v.col(i) -= left / relaxation * start;
    response.a.col(i) += left / (relaxation * relaxation) * start;
  }
}

namespace {

/// Evaluates the Taylor series of the impulse response. The series is used for w t < 1 and c t < 1,
/// where the closed forms suffer from cancellation.
ImpulseResponse impulse_response_by_series(double omega, double decay, double t) {
  const double c = decay * t;
  const double w2 = omega * t * omega * t;
  // The series of the impulse response is h = t sum b_k with b_0 = 1. `before` and `b` are two
  // successive terms b_(k-1) and b_k.
  double before = 0;
  double b = 1;
  ImpulseResponse r{.dh = 0, .h = 0, .h1 = 0, .h2 = 0};
  for (int k = 1; k <= 30; ++k) {
    r.dh += k * b;
    r.h += b;
    r.h1 += b / (k + 1);
    r.h2 += b / ((k + 1) * (k + 2));
    const double next = -(2 * c * k * b + w2 * before) / (k * (k + 1));
    before = b;
    b = next;
  }
  r.h *= t;
  r.h1 *= t * t;
  r.h2 *= t * t * t;
  return r;
}

/// First and second integral of the exponential decay e^(-rate t) over [0, t].
struct Decay {
  double once, twice;
};

Decay integrate_decay(double rate, double t) {
  const double x = rate * t;
  if (x < 0.5) {
    double term = 1;  // (-x)^k / k!
    Decay sum{0, 0};
    for (int k = 0; k < 20; ++k) {
      sum.once += term / (k + 1);
      sum.twice += term / ((k + 1) * (k + 2));
      term *= -x / (k + 1);
    }
    return {sum.once * t, sum.twice * t * t};
  }
  const double once = -std::expm1(-x) / rate;
  return {once, (t - once) / rate};
}

/// Computes the impulse response as the difference of two exponential decays whose rates differ
/// strongly.
ImpulseResponse impulse_response_by_decays(double omega, double decay, double root, double t) {
  const double fast = decay + root, slow = omega * omega / fast;
  const double gap = 2 * root;
  const double e_slow = std::exp(-slow * t);
  const double e_fast = std::exp(-fast * t);
  const Decay s = integrate_decay(slow, t);
  const Decay f = integrate_decay(fast, t);
  return {.dh = (fast * e_fast - slow * e_slow) / gap,
          .h = (e_slow - e_fast) / gap,
          .h1 = (s.once - f.once) / gap,
          .h2 = (s.twice - f.twice) / gap};
}

}  // namespace

ImpulseResponse impulse_response(double omega, double decay, double t) {
  if (omega * t < 1 && decay * t < 1) return impulse_response_by_series(omega, decay, t);
  const double D = (decay - omega) * (decay + omega);
  const double root = std::sqrt(std::abs(D));
  if (D > decay * decay / 4) return impulse_response_by_decays(omega, decay, root, t);
  const double x = root * t;
  const double envelope = std::exp(-decay * t);
  double even = 0;  // envelope * cosh(sqrt(D) t)
  double odd = 0;   // envelope * sinh(sqrt(D) t) / sqrt(D)
  if (x < 1) {
    double term = 1;
    for (int k = 0; k < 12; ++k) {
      even += term;
      odd += term / (2 * k + 1);
      term *= (D > 0 ? x * x : -x * x) / ((2 * k + 1) * (2 * k + 2));
    }
    even *= envelope;
    odd *= envelope * t;
  } else if (D < 0) {
    even = envelope * std::cos(x);
    odd = envelope * std::sin(x) / root;
  } else {
    const double slow = std::exp(-omega * omega / (decay + root) * t);
    const double fast = std::exp(-(decay + root) * t);
    even = (slow + fast) / 2;
    odd = (slow - fast) / (2 * root);
  }
  ImpulseResponse r;
  r.h = odd;
  r.dh = even - decay * odd;
  r.h1 = (1 - (even + decay * odd)) / (omega * omega);
  r.h2 = (t - 2 * decay * r.h1 - r.h) / (omega * omega);
  return r;
}

OscillatorState advance(const ImpulseResponse& r, double omega, const OscillatorState& start,
                        double p0, double p1) {
  const double k = omega * omega;
  return {.y = start.y * (1 - k * r.h1) + start.v * r.h + p0 * r.h1 + p1 * r.h2,
          .v = -start.y * k * r.h + start.v * r.dh + p0 * r.h + p1 * r.h1};
}

RegularizedMass::RegularizedMass(const System& system) : system_(system) {
  constexpr double kShare = 1e-6;
  double fastest = 0;
  for (Index i = 0; i < system.M.rows(); ++i) {
    const double mass = system.M.coeff(i, i);
    if (mass > 0) fastest = std::max(fastest, system.K.coeff(i, i) / mass);
  }
  SparseMatrix sum = system.M;
  if (fastest > 0) sum += kShare / fastest * system.K;
  regular_.compute(sum);
}

VectorXd RegularizedMass::solve(const VectorXd& f) const {
  VectorXd a = regular_.solve(f);
  for (int pass = 0; pass < 2; ++pass) a += regular_.solve(f - system_.M * a);
  return a;
}

LateStrain::LateStrain(const System& system)
    : system_(system), mass_(system), weight_(system.T.transpose() * system.weight) {}

void LateStrain::set_loads(const VectorXd& q, const Eigen::Vector2d& factors,
                           ElasticState& elastic) const {
  const VectorXd loads = factors[0] * (system_.f - weight_) + factors[1] * weight_;
  elastic.acceleration = system_.T * mass_.solve(loads - system_.K * q);
  elastic.load_factor = factors[0];
  elastic.weight_factor = factors[1];
}

}  // namespace trammel::solver
