#include "solver/elastodynamics/member_interpolation.h"

namespace trammel::solver {

MemberInterpolation::MemberInterpolation(const System& system) {
  const Model& model = system.model;
  const std::size_t nodes = system.mesh.positions.size();
  span_.resize(nodes);
  fraction_.assign(nodes, 0.0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    span_[i] = {static_cast<Index>(i), static_cast<Index>(i)};
  }
  Index before = -1;
  Index done = 0;
  for (const FrameElement& e : system.mesh.frame) {
    const Member& member = model.members[static_cast<std::size_t>(e.member)];
    done = e.member == before ? done + 1 : 1;
    before = e.member;
    if (done == member.elements) continue;  // its second node is the member's
    const auto node = static_cast<std::size_t>(e.nodes[1]);
    span_[node] = member.nodes;
    fraction_[node] = static_cast<double>(done) / static_cast<double>(member.elements);
  }
}

Vector2d MemberInterpolation::at(Index mesh_node, const Eigen::MatrixX2d& values) const {
  const double s = fraction_[to_size(mesh_node)];
  const auto [first, second] = span_[to_size(mesh_node)];
  return (1 - s) * values.row(first).transpose() + s * values.row(second).transpose();
}

}  // namespace trammel::solver
