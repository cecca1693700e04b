#pragma once

#include "solver/large_motion/system/system_parts.h"

namespace trammel::solver::large_motion {

/// A force [N, N] and a moment [N m] in the model's pose, on (x, y, rotation) of a node.
struct FollowerForce {
  static constexpr int N = 3;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
};

/// Forces and moments that rotate with their nodes, f = load R(theta) F; their stiffness
/// -df/dtheta is not symmetric.
class FollowerLoads final : public ElementList<FollowerForce, 0> {
 public:
  using ElementList::ElementList;

  void forces(const State& state, double tau, Eigen::Ref<VectorXd> r) const override;
  void tangent(const State& state, double tau, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override;
  void discrete_gradient_forces(const State& from, const State& to, const VectorXd& lambda,
                                double tau, Eigen::Ref<VectorXd> r) const override;
  /// Adds -df/dload to r.
  void add_load_derivative(const State& state, Eigen::Ref<VectorXd> r) const;

 private:
  void add_force(Index e, double angle, double factor, Eigen::Ref<VectorXd> r) const;
};

/// Adds the dead loads of nodes and edges (those of members come with their elements), and the
/// follower loads.
void add_loads(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
               SystemParts& parts);

/// Gravity at the translations of nodes, element nodes and mass centres, zero at rotations
/// [m/s^2]: the weight is M times this.
[[nodiscard]] VectorXd gravity_field(const Model& model, const Layout& layout);

}  // namespace trammel::solver::large_motion
