#include "solver/large_motion/system/loads.h"

#include "solver/elements/edge_load.h"
#include "solver/model/plane.h"

namespace trammel::solver::large_motion {

void FollowerLoads::add_force(Index e, double angle, double factor, Eigen::Ref<VectorXd> r) const {
  const Eigen::Vector3d& force = element(e).force;
  Eigen::Vector3d f;
  f << rotated(force.head<2>(), angle), force[2];
  const Eigen::Vector3d residual = -factor * f;
  scatter<3>(residual, coordinates(e), r);
}

void FollowerLoads::forces(const State& state, double, Eigen::Ref<VectorXd> r) const {
  for (Index e = 0; e < size(); ++e) {
    add_force(e, gather<3>(state.q, coordinates(e))[2], state.load, r);
  }
}

void FollowerLoads::tangent(const State& state, double, const TangentCoefficients& coefficients,
                            KktMatrix& matrix) const {
  for (Index e = 0; e < size(); ++e) {
    const double angle = gather<3>(state.q, coordinates(e))[2];
    Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
    S.block<2, 1>(0, 2) = -coefficients.stiffness * state.load *
                          perpendicular(rotated(element(e).force.head<2>(), angle));
    matrix.add(block(e), S);
  }
}

void FollowerLoads::discrete_gradient_forces(const State& from, const State& to, const VectorXd&,
                                             double, Eigen::Ref<VectorXd> r) const {
  for (Index e = 0; e < size(); ++e) {
    const double angle =
        (gather<3>(from.q, coordinates(e))[2] + gather<3>(to.q, coordinates(e))[2]) / 2;
    add_force(e, angle, (from.load + to.load) / 2, r);
  }
}

void FollowerLoads::add_load_derivative(const State& state, Eigen::Ref<VectorXd> r) const {
  for (Index e = 0; e < size(); ++e) add_force(e, gather<3>(state.q, coordinates(e))[2], 1, r);
}

void add_loads(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
               SystemParts& parts) {
  for (const NodalLoad& load : model.loads) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double force = load.force[static_cast<Index>(k)];
      if (force != 0) parts.loads[layout.node[to_size(load.node)][k]] += force;
    }
  }
  for (const EdgeLoad& load : model.edge_loads) {
    const std::array<Vector2d, 3> force = edge_forces(model, load);
    for (std::size_t i = 0; i < 3; ++i) {
      if (load.nodes[i] < 0) continue;
      for (std::size_t k = 0; k < 2; ++k) {
        parts.loads[layout.node[to_size(load.nodes[i])][k]] += force[i][static_cast<Index>(k)];
      }
    }
  }
  auto group = std::make_unique<FollowerLoads>(layout.free);
  for (const FollowerLoad& load : large_motion.follower_loads) {
    group->add({load.force}, layout.node[to_size(load.node)]);
  }
  if (group->size() > 0) parts.follower_loads = group.get();
  parts.add(std::move(group));
}

VectorXd gravity_field(const Model& model, const Layout& layout) {
  VectorXd field = VectorXd::Zero(layout.total);
  const auto set = [&](Index x, Index y) {
    field[x] = model.gravity.x();
    field[y] = model.gravity.y();
  };
  for (const auto& node : layout.node) set(node[0], node[1]);
  for (const auto& centre : layout.mass_centre) set(centre[0], centre[1]);
  for (const MemberElement& element : layout.elements) {
    for (std::size_t a = 0; a < element.coordinates.size(); a += element.is_bar() ? 2 : 3) {
      set(element.coordinates[a], element.coordinates[a + 1]);
    }
  }
  return field;
}

}  // namespace trammel::solver::large_motion
