#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "solver/large/constrained_system.h"

namespace trammel::testing {

using namespace solver::large_motion;

/// A small dense system given as functions, for equations that are not a `Model` of ours:
/// M(q) a = f(t, q, v) - G(t, q)^T lambda, g(t, q) = 0. Tangents are taken by differences.
struct CallableEquations {
  Index coordinates = 0;
  Index constraints = 0;
  std::function<Eigen::MatrixXd(const VectorXd& q)> mass;
  std::function<VectorXd(double t, const VectorXd& q, const VectorXd& v)> force;
  std::function<VectorXd(double t, const VectorXd& q)> constraint_residual;
  std::function<Eigen::MatrixXd(double t, const VectorXd& q)> jacobian;  ///< dg/dq
  std::function<VectorXd(double t, const VectorXd& q)>
      constraint_time_derivative;  ///< dg/dt; empty: 0
  VectorXd scale;                  ///< what counts as a unit change of each coordinate
};

class CallableSystem final : public ConstrainedSystem {
 public:
  explicit CallableSystem(CallableEquations equations);

  [[nodiscard]] Index coordinates() const override { return equations_.coordinates; }
  [[nodiscard]] Index constraints() const override { return equations_.constraints; }
  [[nodiscard]] const VectorXd& compliance() const override { return compliance_; }
  [[nodiscard]] const VectorXd& scale() const override { return equations_.scale; }
  [[nodiscard]] std::vector<std::vector<Index>> blocks() const override;
  void force_residual(const State& state, Eigen::Ref<VectorXd> r) const override;
  void constraint_residual(const State& state, Eigen::Ref<VectorXd> residual,
                           Eigen::Ref<VectorXd> rate) const override;
  void tangent(const State& state, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override;
  [[nodiscard]] bool symmetric() const override { return false; }

 private:
  CallableEquations equations_;
  VectorXd compliance_;
};

}  // namespace trammel::testing
