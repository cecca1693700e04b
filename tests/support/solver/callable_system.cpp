#include "tests/support/solver/callable_system.h"

#include <cmath>
#include <numeric>
#include <utility>

namespace trammel::testing {

CallableSystem::CallableSystem(CallableEquations equations)
    : equations_(std::move(equations)), compliance_(VectorXd::Zero(equations_.constraints)) {}

std::vector<std::vector<Index>> CallableSystem::blocks() const {
  std::vector<Index> all(static_cast<std::size_t>(coordinates() + constraints()));
  std::iota(all.begin(), all.end(), Index{0});
  return {all};
}

void CallableSystem::force_residual(const State& state, Eigen::Ref<VectorXd> r) const {
  r = equations_.mass(state.q) * state.a - equations_.force(state.t, state.q, state.v) +
      equations_.jacobian(state.t, state.q).transpose() * state.lambda;
}

void CallableSystem::constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                                         Eigen::Ref<VectorXd> rate) const {
  residual = equations_.constraint_residual(state.t, state.q);
  rate = equations_.jacobian(state.t, state.q) * state.v;
  if (equations_.constraint_time_derivative)
    rate += equations_.constraint_time_derivative(state.t, state.q);
}

void CallableSystem::tangent(const State& state, const TangentCoefficients& coefficients,
                             KktMatrix& matrix) const {
  const Index n = coordinates();
  Eigen::MatrixXd S = coefficients.mass * equations_.mass(state.q);
  const VectorXd mass = S.diagonal();
  VectorXd plus(n), minus(n);
  const auto difference = [&](VectorXd State::*part, Index i, double step, double weight) {
    State probe = state;
    (probe.*part)[i] += step;
    force_residual(probe, plus);
    (probe.*part)[i] -= 2 * step;
    force_residual(probe, minus);
    S.col(i) += weight / (2 * step) * (plus - minus);
  };
  const double speed = state.v.cwiseQuotient(scale()).cwiseAbs().maxCoeff();
  for (Index i = 0; i < n; ++i) {
    const double step = 1e-5 * scale()[i];
    if (coefficients.stiffness != 0) difference(&State::q, i, step, coefficients.stiffness);
    if (coefficients.damping != 0)
      difference(&State::v, i, step * (1 + speed), coefficients.damping);
  }
  const VectorXd c = VectorXd::Zero(constraints());
  const double typical = mass.cwiseProduct(scale().cwiseAbs2()).mean();
  const Eigen::MatrixXd G = equations_.jacobian(state.t, state.q);
  VectorXd rho(constraints());
  for (Index r = 0; r < constraints(); ++r) {
    rho[r] = typical / G.row(r).transpose().cwiseProduct(scale()).squaredNorm();
  }
  matrix.add(0, S, G, G, c, rho);
}

}  // namespace trammel::testing
