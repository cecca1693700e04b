#include "solver/time/modal_superposition.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/factorization.h"
#include "solver/model/model.h"
#include "solver/model/numbers.h"
#include "solver/time/oscillator.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

/// Value and slope of the factors in the interval that begins at a time.
struct Factor {
  VectorXd value, slope;
};

/// Visits the intervals between the samples and the times of the load.
/// @param sample  (index of the sample, factors from there)
/// @param advance  (length of the interval, its factors)
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
  if (!(trace > 0)) throw ModelError("a model without mass has no modes");
  // M x = mu (K + s M) x with a shift far below the bulk of the spectrum: mu = 1 / (w^2 + s).
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
  // What round-off of the stiffest mode can make of zero is zero.
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
  const VectorXd y0 = project(q0);
  const VectorXd w0 = project(v0);
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

FollowedFactors followed_factors(const PiecewiseLinearLoad& load, double relaxation,
                                 const VectorXd& start, const std::vector<double>& times) {
  FollowedFactors found;
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
    // By their equation, in which round-off of what is at rest is none.
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

void add_massless_coordinates(const ModalBasis& basis, const SparseMatrix& M, const SparseMatrix& K,
                              double relaxation, const PiecewiseLinearLoad& load,
                              const std::vector<double>& times, const VectorXd& q0,
                              ModalResponse& response, Counters& counters) {
  const auto beside_modes = [&](const VectorXd& x) -> VectorXd {
    return x - basis.shape * (basis.shape.transpose() * (M * x));
  };
  const Eigen::MatrixXd rest =
      load.pattern - M * (basis.shape * (basis.shape.transpose() * load.pattern));
  if (rest.norm() > 1e-9 * load.pattern.norm()) {
    // With M x = 0 any multiple of M may be added to K, which free motions make singular.
    const double shift = K.diagonal().sum() / M.diagonal().sum();
    Factorization factorization;
    factorization.compute(SparseMatrix(K + shift * M));
    ++counters.factorizations;
    if (!factorization.exists()) return;
    Eigen::MatrixXd held(rest.rows(), rest.cols());
    for (Index i = 0; i < rest.cols(); ++i)
      held.col(i) = beside_modes(factorization.solve(rest.col(i)));
    counters.solves += rest.cols();
    const FollowedFactors followed =
        followed_factors(load, relaxation, VectorXd::Zero(rest.cols()), times);
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

}  // namespace trammel::solver
