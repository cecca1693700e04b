#include "solver/linear/coordinates.h"

#include "solver/linear/element_operators.h"
#include "solver/model/model.h"

namespace trammel::solver {
namespace {

bool rotates_with_node(const MemberEnd& end) {
  return end.fixity != EndFixity::hinged;
}

/// Returns one value per node of the model: true if the node has a rotation.
std::vector<bool> nodes_with_rotation(const Model& model) {
  std::vector<bool> turns(model.nodes.size(), false);
  std::vector<bool> joined(model.nodes.size(), false);
  const auto give = [&turns](Index node) { turns[to_size(node)] = true; };
  for (const Member& member : model.members) {
    for (std::size_t end = 0; end < 2; ++end) {
      joined[to_size(member.nodes[end])] = true;
      if (rotates_with_node(member.ends[end])) give(member.nodes[end]);
    }
  }
  std::vector<bool> held(model.nodes.size(), false);
  for (const RigidBody& body : model.rigid_bodies) {
    give(body.reference);
    for (const Index node : body.attached) held[to_size(node)] = true;
  }
  for (const NodalLoad& load : model.loads) {
    if (load.force[2] != 0 && held[to_size(load.node)]) give(load.node);
  }
  for (const PointMass& mass : model.masses) {
    if (mass.inertia > 0 || (mass.mass > 0 && !mass.offset.isZero(0))) give(mass.node);
  }
  for (const Spring& spring : model.springs) {
    if (spring.stiffness[2] == 0) continue;
    for (const Index node : spring.nodes) {
      if (node >= 0) give(node);
    }
  }
  for (const Support& support : model.supports) {
    const auto node = to_size(support.node);
    if (support.fixed[2] && (joined[node] || held[node])) give(support.node);
  }
  return turns;
}

class Discretiser {
 public:
  explicit Discretiser(const Model& model) : model_(model) {}

  Discretisation run() {
    const std::vector<bool> turns = nodes_with_rotation(model_);
    for (std::size_t i = 0; i < model_.nodes.size(); ++i)
      add_node(model_.nodes[i].position, turns[i]);
    out_.coordinates.member_end.reserve(model_.members.size());
    for (std::size_t i = 0; i < model_.members.size(); ++i) cut(static_cast<Index>(i));
    return std::move(out_);
  }

 private:
  Index add_coordinate(Index node, bool is_rotation) {
    out_.coordinates.node_of.push_back(node);
    out_.coordinates.is_rotation.push_back(is_rotation);
    return out_.coordinates.size++;
  }

  Index add_node(const Vector2d& position, bool turns) {
    const auto node = static_cast<Index>(out_.mesh.positions.size());
    out_.mesh.positions.push_back(position);
    const Index x = add_coordinate(node, false);
    const Index y = add_coordinate(node, false);
    out_.coordinates.node.push_back({x, y, turns ? add_coordinate(node, true) : -1});
    return node;
  }

  [[nodiscard]] const std::array<Index, 3>& of(Index node) const {
    return out_.coordinates.node[to_size(node)];
  }

  Index end_rotation(const Member& member, std::size_t end, bool bends) {
    if (!bends) return -1;
    if (member.ends[end].fixity == EndFixity::welded) return of(member.nodes[end])[2];
    return add_coordinate(member.nodes[end], true);
  }

  void cut(Index index) {
    const Member& member = model_.members[to_size(index)];
    const auto count = static_cast<double>(member.elements);
    const Vector2d start = model_.nodes[to_size(member.nodes[0])].position;
    const Vector2d span = model_.nodes[to_size(member.nodes[1])].position - start;
    const bool bends = section_at(member, 0.5).EI > 0;
    const Index first_rotation = end_rotation(member, 0, bends);
    FrameElement element;
    element.member = index;
    element.length = span.norm() / count;
    element.direction = span.normalized();
    element.nodes[1] = member.nodes[0];
    for (Index i = 0; i < member.elements; ++i) {
      const bool last = i + 1 == member.elements;
      element.section = section_at(member, (static_cast<double>(i) + 0.5) / count);
      element.nodes[0] = element.nodes[1];
      element.nodes[1] = last ? member.nodes[1]
                              : add_node(start + span * (static_cast<double>(i + 1) / count), true);
      const Index rotation1 = i == 0 ? first_rotation : of(element.nodes[0])[2];
      const Index rotation2 = last ? end_rotation(member, 1, bends) : of(element.nodes[1])[2];
      element.coordinates = {of(element.nodes[0])[0], of(element.nodes[0])[1], rotation1,
                             of(element.nodes[1])[0], of(element.nodes[1])[1], rotation2};
      element.mass = world_mass_matrix(element, member);
      out_.mesh.frame.push_back(element);
      if (last) out_.coordinates.member_end.push_back({first_rotation, rotation2});
    }
  }

  const Model& model_;
  Discretisation out_;
};

}  // namespace

Index Coordinates::index_of(const Model& model, const Coordinate& coordinate) const {
  if (coordinate.kind == Coordinate::Kind::end_rotation) {
    if (coordinate.member < 0 || coordinate.member >= std::ssize(member_end) ||
        coordinate.end < 0 || coordinate.end > 1)
      throw ModelError("a constraint refers to an end of a member that does not exist");
    const Index found = member_end[to_size(coordinate.member)][to_size(coordinate.end)];
    if (found >= 0) return found;
    throw ModelError(member_label(model, coordinate.member) + " does not bend: its ends have no " +
                     "rotation");
  }
  if (coordinate.node < 0 || coordinate.node >= static_cast<Index>(model.nodes.size()))
    throw ModelError("a constraint refers to a node that does not exist");
  const Index found = node[to_size(coordinate.node)][static_cast<std::size_t>(coordinate.kind)];
  if (found >= 0) return found;
  throw ModelError(node_label(model, coordinate.node) +
                   " has no rotation: no member end is welded to it, no rigid body contains it");
}

Discretisation discretize(const Model& model) {
  return Discretiser(model).run();
}

}  // namespace trammel::solver
