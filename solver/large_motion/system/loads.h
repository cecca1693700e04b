#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/large_motion/system/element_group.h"
#include "solver/large_motion/system/joints.h"

namespace trammel::solver::large_motion {

/// Linear spring between two coordinates, k (q1 - q0).
struct CoordinateSpring {
  static constexpr int N = 2;
  using Coordinates = Eigen::Vector2d;
  using Square = Eigen::Matrix2d;
  double stiffness = 0;

  [[nodiscard]] Square matrix() const {
    return (Square() << stiffness, -stiffness, -stiffness, stiffness).finished();
  }
  [[nodiscard]] double energy(const Coordinates& q) const { return q.dot(matrix() * q) / 2; }
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const {
    return matrix() * (q + tau * v);
  }
  [[nodiscard]] Square tangent(const Coordinates&, double k, double d) const {
    return (k + d) * matrix();
  }
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double rate) const {
    return matrix() * ((q0 + q1) / 2 + rate * (q1 - q0));
  }
  [[nodiscard]] Square mass() const { return Square::Zero(); }
};

/// Forces and moments that turn with their nodes, f = R(theta) F; their stiffness is not symmetric.
class FollowerLoads final : public ElementGroup {
 public:
  explicit FollowerLoads(Index free) : free_(free) {}

  /// @param where  x, y, rotation of the node.
  void add(const Eigen::Vector3d& force, const std::array<Index, 3>& where) {
    forces_.push_back(force);
    where_.push_back(where);
  }

  void append_blocks(std::vector<std::vector<Index>>& blocks) override {
    first_block_ = static_cast<Index>(blocks.size());
    for (const std::array<Index, 3>& where : where_) {
      std::vector<Index> block;
      for (const Index i : where) block.push_back(i < free_ ? i : -1);
      blocks.push_back(std::move(block));
    }
  }

  void forces(const State& state, double, Eigen::Ref<VectorXd> r) const override {
    for (std::size_t e = 0; e < forces_.size(); ++e) {
      add_force(e, gather<3>(state.q, where_[e])[2], state.load, r);
    }
  }

  void tangent(const State& state, double, const TangentCoefficients& coefficients,
               KktMatrix& matrix) const override {
    for (std::size_t e = 0; e < forces_.size(); ++e) {
      const double angle = gather<3>(state.q, where_[e])[2];
      Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
      S.block<2, 1>(0, 2) = -coefficients.stiffness * state.load *
                            perpendicular(rotated(forces_[e].head<2>(), angle));
      matrix.add(first_block_ + static_cast<Index>(e), S);
    }
  }

  void discrete_gradient_forces(const State& from, const State& to, const VectorXd&, double,
                                Eigen::Ref<VectorXd> r) const override {
    for (std::size_t e = 0; e < forces_.size(); ++e) {
      const double angle = (gather<3>(from.q, where_[e])[2] + gather<3>(to.q, where_[e])[2]) / 2;
      add_force(e, angle, (from.load + to.load) / 2, r);
    }
  }

  /// Adds -df/dload to r.
  void add_load_derivative(const State& state, Eigen::Ref<VectorXd> r) const {
    for (std::size_t e = 0; e < forces_.size(); ++e) {
      add_force(e, gather<3>(state.q, where_[e])[2], 1, r);
    }
  }

  [[nodiscard]] Index size() const override { return static_cast<Index>(forces_.size()); }

 private:
  void add_force(std::size_t e, double angle, double factor, Eigen::Ref<VectorXd> r) const {
    Eigen::Vector3d f;
    f << rotated(forces_[e].head<2>(), angle), forces_[e][2];
    const Eigen::Vector3d pushed = -factor * f;
    scatter<3>(pushed, where_[e], r);
  }

  Index free_ = 0, first_block_ = 0;
  std::vector<Eigen::Vector3d> forces_;
  std::vector<std::array<Index, 3>> where_;
};

}  // namespace trammel::solver::large_motion
