#include "solver/time/modal_superposition.h"

#include <algorithm>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/linalg/factorization.h"
#include "solver/model/numbers.h"
#include "solver/time/oscillator.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

void check(const PiecewiseLinearLoad& load) {
  if (load.factor.cols() != static_cast<Index>(load.time.size()) ||
      load.factor.rows() != load.pattern.cols() || load.time.empty()) {
    throw ModelError("a piecewise linear load has a factor for each of its loads and times");
  }
  if (!std::is_sorted(load.time.begin(), load.time.end())) {
    throw ModelError("the times of a load ascend");
  }
}

/// Value and slope of the factors in the interval that begins at t.
struct Factor {
  VectorXd value, slope;
};

Factor factor_from(const PiecewiseLinearLoad& load, double t) {
  const auto next = std::upper_bound(load.time.begin(), load.time.end(), t);
  const auto k = static_cast<Index>(next - load.time.begin());
  const VectorXd zero = VectorXd::Zero(load.factor.rows());
  if (k == 0) return {load.factor.col(0), zero};
  if (next == load.time.end()) return {load.factor.col(k - 1), zero};
  const double begin = *(next - 1);
  const VectorXd slope = (load.factor.col(k) - load.factor.col(k - 1)) / (*next - begin);
  return {load.factor.col(k - 1) + (t - begin) * slope, slope};
}

/// Times at which the modes stop: the samples and the load's own.
std::vector<double> stops(const PiecewiseLinearLoad& load, const std::vector<double>& times) {
  std::vector<double> all = times;
  for (const double t : load.time) {
    if (t > times.front() && t < times.back()) all.push_back(t);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

void PiecewiseLinearLoad::at(double t, VectorXd& f) const {
  const auto next = std::upper_bound(time.begin(), time.end(), t);
  const auto k = static_cast<Index>(next - time.begin());
  if (k == 0 || next == time.end()) {
    f.noalias() = pattern * factor.col(std::max<Index>(k, 1) - 1);
    return;
  }
  const double s = (t - *(next - 1)) / (*next - *(next - 1));
  f.noalias() = pattern * factor.col(k - 1) * (1 - s);
  f.noalias() += pattern * factor.col(k) * s;
}

void PiecewiseLinearLoad::apply_to(EquationOfMotion& equation) const {
  check(*this);
  if (pattern.rows() != equation.M.rows()) {
    throw ModelError("the load has the size of the equation of motion");
  }
  equation.breakpoints.insert(equation.breakpoints.end(), time.begin(), time.end());
  equation.load = [self = *this](double t, VectorXd& f) { self.at(t, f); };
}

PiecewiseLinearLoad step_load(const VectorXd& pattern, double start) {
  return {.pattern = pattern,
          .time = {start, start},
          .factor = (Eigen::MatrixXd(1, 2) << 0, 1).finished()};
}

PiecewiseLinearLoad load_by_history(const LoadHistory& history, const VectorXd& varied,
                                    const VectorXd& constant) {
  PiecewiseLinearLoad load;
  load.pattern.resize(varied.size(), 2);
  load.pattern << varied, constant;
  load.time = history.time;
  load.factor.setOnes(2, std::ssize(history.factor));
  load.factor.row(0) =
      Eigen::Map<const Eigen::RowVectorXd>(history.factor.data(), std::ssize(history.factor));
  return load;
}

ModalBasis all_modes(const SparseMatrix& M, const SparseMatrix& K) {
  if (M.rows() != K.rows() || M.cols() != K.cols() || M.rows() != M.cols()) {
    throw ModelError("M and K are square and of one size");
  }
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
  check(load);
  const Index n = basis.shape.rows();
  const Index modes = basis.omega.size();
  const auto fits = [n](const VectorXd& x) { return x.size() == 0 || x.size() == n; };
  if (M.rows() != n || load.pattern.rows() != n || decay.size() != modes || !fits(q0) ||
      !fits(v0)) {
    throw ModelError("modes, mass, load and state of a superposition have one size");
  }
  if (times.empty() || !std::is_sorted(times.begin(), times.end())) {
    throw ModelError("the times of a response ascend");
  }
  const auto columns = static_cast<Index>(times.size());
  const Eigen::MatrixXd pattern = basis.shape.transpose() * load.pattern;
  std::vector<OscillatorState> state(static_cast<std::size_t>(modes));
  const auto project = [&](const VectorXd& x) -> VectorXd {
    if (x.size() == 0) return VectorXd::Zero(modes);
    return basis.shape.transpose() * (M * x);
  };
  const VectorXd y0 = project(q0);
  const VectorXd w0 = project(v0);
  for (Index i = 0; i < modes; ++i) state[static_cast<std::size_t>(i)] = {y0[i], w0[i]};

  Eigen::MatrixXd y(modes, columns);
  Eigen::MatrixXd v(modes, columns);
  Eigen::MatrixXd a(modes, columns);
  Index sample = 0;
  const std::vector<double> all = stops(load, times);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Factor factor = factor_from(load, all[k]);
    const VectorXd p0 = pattern * factor.value;
    const VectorXd p1 = pattern * factor.slope;
    for (; sample < columns && times[static_cast<std::size_t>(sample)] == all[k]; ++sample) {
      for (Index i = 0; i < modes; ++i) {
        const OscillatorState& s = state[static_cast<std::size_t>(i)];
        const double w = basis.omega[i];
        y(i, sample) = s.y;
        v(i, sample) = s.v;
        a(i, sample) = p0[i] - 2 * decay[i] * s.v - w * w * s.y;
      }
    }
    if (k + 1 == all.size()) break;
    for (Index i = 0; i < modes; ++i) {
      OscillatorState& s = state[static_cast<std::size_t>(i)];
      const double w = basis.omega[i];
      s = advance(impulse_response(w, decay[i], all[k + 1] - all[k]), w, s, p0[i], p1[i]);
    }
  }
  return {basis.shape * y, basis.shape * v, basis.shape * a};
}

FollowedFactors followed_factors(const PiecewiseLinearLoad& load, double relaxation,
                                 const VectorXd& start, const std::vector<double>& times) {
  FollowedFactors found;
  const auto columns = static_cast<Index>(times.size());
  for (Eigen::MatrixXd* m : {&found.value, &found.rate, &found.acceleration})
    m->setZero(load.factor.rows(), columns);
  VectorXd y = start;
  Index sample = 0;
  const std::vector<double> all = stops(load, times);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Factor factor = factor_from(load, all[k]);
    const bool lags = relaxation > 0;
    const VectorXd settled = factor.value - relaxation * factor.slope;
    const VectorXd away = lags ? VectorXd(y - settled) : VectorXd::Zero(y.size());
    for (; sample < columns && times[to_size(sample)] == all[k]; ++sample) {
      found.value.col(sample) = settled + away;
      found.rate.col(sample) = factor.slope;
      if (!lags) continue;
      // By their equation, in which round-off of what is at rest is none.
      found.rate.col(sample) = (factor.value - found.value.col(sample)) / relaxation;
      found.acceleration.col(sample) = (factor.slope - found.rate.col(sample)) / relaxation;
    }
    if (!lags || k + 1 == all.size()) continue;
    const double step = all[k + 1] - all[k];
    y = settled + step * factor.slope + std::exp(-step / relaxation) * away;
  }
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
