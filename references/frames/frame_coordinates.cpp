#include "references/frames/frame_coordinates.h"

#include <algorithm>

namespace trammel::references {

namespace {

/// Returns true for each node that has a rotation: a node with a member end that is not hinged, a
/// rigid body, a mass with inertia or offset, or a rotational spring.
std::vector<bool> nodes_with_rotation(const Frame& frame) {
  std::vector<bool> has_rotation(frame.nodes.size(), false);
  for (const FrameMember& member : frame.members) {
    for (int end = 0; end < 2; ++end) {
      if (member.ends[end].fixity != Fixity::hinged) has_rotation[member.nodes[end]] = true;
    }
  }
  for (const FrameBody& body : frame.bodies) has_rotation[body.reference] = true;
  for (const FrameMass& mass : frame.masses) {
    if (mass.inertia > 0 || mass.offset[0] != 0 || mass.offset[1] != 0)
      has_rotation[mass.node] = true;
  }
  for (const FrameSpring& spring : frame.springs) {
    for (const int node : spring.nodes) {
      if (node >= 0 && spring.stiffness[2] > 0) has_rotation[node] = true;
    }
  }
  return has_rotation;
}

}  // namespace

FrameCoordinates::FrameCoordinates(const Frame& frame, bool constrain_inextensible) {
  number_coordinates(frame);
  eliminate_constraints(constraint_equations(frame, constrain_inextensible));
}

void FrameCoordinates::number_coordinates(const Frame& frame) {
  const std::vector<bool> has_rotation = nodes_with_rotation(frame);
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    node_.push_back({size_, size_ + 1, has_rotation[i] ? size_ + 2 : -1});
    size_ += has_rotation[i] ? 3 : 2;
  }
  for (const FrameMember& member : frame.members) {
    std::array<int, 6> indices{};
    for (int end = 0; end < 2; ++end) {
      std::ranges::copy(node_[member.nodes[end]], indices.begin() + 3 * end);
      if (member.ends[end].fixity != Fixity::welded) indices[3 * end + 2] = size_++;
    }
    member_.push_back(indices);
  }
}

std::vector<SpringElement> FrameCoordinates::springs(const Frame& frame) const {
  std::vector<SpringElement> result;
  for (const FrameSpring& spring : frame.springs) {
    for (int motion = 0; motion < 3; ++motion) {
      if (spring.stiffness[motion] == 0) continue;
      const int to = node_coordinate_index(spring.nodes[0], motion);
      const int from = spring.nodes[1] < 0 ? -1 : node_coordinate_index(spring.nodes[1], motion);
      result.push_back({from, to, spring.stiffness[motion]});
    }
  }
  for (std::size_t i = 0; i < frame.members.size(); ++i) {
    const FrameMember& member = frame.members[i];
    for (int end = 0; end < 2; ++end) {
      if (member.ends[end].fixity != Fixity::sprung) continue;
      result.push_back({node_coordinate_index(member.nodes[end], 2),
                        end_rotation_index(static_cast<int>(i), end), member.ends[end].stiffness});
    }
  }
  return result;
}

std::vector<FrameCoordinates::Row> FrameCoordinates::constraint_equations(
    const Frame& frame, bool constrain_inextensible) const {
  std::vector<Row> rows;
  for (const FrameSupport& support : frame.supports) {
    for (int motion = 0; motion < 3; ++motion) {
      const int index = node_[support.node][motion];
      if (support.fixed[motion] && index >= 0) rows.push_back({{index, Real(1)}});
    }
  }
  for (const FrameBody& body : frame.bodies) {
    const auto& r = node_[body.reference];
    for (const int node : body.attached) {
      const auto& a = node_[node];
      const Real dx = frame.nodes[node].position[0] - frame.nodes[body.reference].position[0];
      const Real dy = frame.nodes[node].position[1] - frame.nodes[body.reference].position[1];
      rows.push_back({{a[0], Real(1)}, {r[0], Real(-1)}, {r[2], dy}});
      rows.push_back({{a[1], Real(1)}, {r[1], Real(-1)}, {r[2], -dx}});
      if (a[2] >= 0) rows.push_back({{a[2], Real(1)}, {r[2], Real(-1)}});
    }
  }
  for (const FrameMember& member : frame.members) {
    if (!constrain_inextensible || member.section.axial_compliance > 0) continue;
    const MemberAxis axis = member_axis(frame, member);
    const auto& a = node_[member.nodes[0]];
    const auto& b = node_[member.nodes[1]];
    rows.push_back(
        {{a[0], -axis.cosine}, {a[1], -axis.sine}, {b[0], axis.cosine}, {b[1], axis.sine}});
  }
  for (const RotationConstraint& constraint : frame.constraints) {
    rows.push_back({{node_[constraint.node][2], Real(-1)}});
    for (const auto& [member, end] : constraint.ends)
      rows.back()[end_rotation_index(member, end)] += constraint.share;
  }
  return rows;
}

void FrameCoordinates::eliminate_constraints(const std::vector<Row>& equations) {
  RealMatrix C = RealMatrix::Zero(static_cast<Eigen::Index>(equations.size()), size_);
  for (std::size_t i = 0; i < equations.size(); ++i) {
    for (const auto& [column, coefficient] : equations[i]) C(i, column) = coefficient;
  }
  Eigen::FullPivLU<RealMatrix> lu(C);
  lu.setThreshold(Real(1e-30));  // smaller pivots count as 0: dependent equations
  N_ = lu.dimensionOfKernel() > 0 ? RealMatrix(lu.kernel()) : RealMatrix(size_, 0);
  N_ = (N_.array().abs() < Real(1e-40)).select(Real(0), N_);
}

}  // namespace trammel::references
