#include "solver/large_motion/system/layout.h"

#include <numeric>
#include <optional>
#include <utility>

#include "solver/elements/frame_element.h"
#include "solver/model/labels.h"
#include "solver/model/numbers.h"

namespace trammel::large {

namespace {

class Numbering {
 public:
  Numbering(const Model& model, const Scenario& scenario, int order)
      : model_(model), scenario_(scenario), order_(order) {}

  Layout run() {
    share_rotations();
    find_rotations();
    number_nodes();
    for (Index m = 0; m < static_cast<Index>(model_.members.size()); ++m) number_member(m);
    layout_.first_element.push_back(static_cast<Index>(layout_.elements.size()));
    number_masses();
    share_equal();
    hold_supports();
    free_first();
    return std::move(layout_);
  }

 private:
  void share_rotations() {
    owner_.resize(model_.nodes.size());
    std::iota(owner_.begin(), owner_.end(), Index{0});
    for (const RigidBody& body : model_.rigid_bodies) {
      for (const Index node : body.attached) owner_[to_size(owner(node))] = owner(body.reference);
    }
  }

  Index owner(Index node) const {
    while (owner_[to_size(node)] != node) node = owner_[to_size(node)];
    return node;
  }

  void find_rotations() {
    turns_.assign(model_.nodes.size(), false);
    const auto need = [&](Index node) {
      if (node >= 0) turns_[to_size(owner(node))] = true;
    };
    for (const Member& member : model_.members) {
      for (std::size_t end = 0; end < 2; ++end) {
        if (member.ends[end].fixity != EndFixity::hinged) need(member.nodes[end]);
      }
    }
    for (const RigidBody& body : model_.rigid_bodies) need(body.reference);
    for (const PointMass& mass : model_.masses) {
      if (mass.inertia != 0 || !mass.offset.isZero(0)) need(mass.node);
    }
    for (const Spring& spring : model_.springs) {
      if (spring.stiffness[2] != 0) need(spring.nodes[0]);
      if (spring.stiffness[2] != 0) need(spring.nodes[1]);
    }
    for (const NodalLoad& load : model_.loads) {
      if (load.force[2] != 0) need(load.node);
    }
    for (const LinearConstraint& constraint : model_.constraints) {
      for (const auto& [coordinate, factor] : constraint.terms) {
        if (coordinate.kind == Coordinate::Kind::rotation) need(coordinate.node);
      }
    }
    for (const Drive& drive : scenario_.drives) {
      if (drive.direction == 2) need(drive.node);
    }
    for (const FollowerLoad& load : scenario_.follower_loads) need(load.node);
    for (const Slider& slider : scenario_.sliders) {
      need(slider.rail);
      if (slider.keeps_angle) need(slider.node);
    }
  }

  Index add(bool rotation) {
    layout_.is_rotation.push_back(rotation);
    held_.push_back(false);
    return layout_.total++;
  }

  void number_nodes() {
    layout_.node.assign(model_.nodes.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      layout_.node[i][0] = add(false);
      layout_.node[i][1] = add(false);
      if (turns_[i] && owner(static_cast<Index>(i)) == static_cast<Index>(i)) {
        layout_.node[i][2] = add(true);
      }
    }
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      layout_.node[i][2] = layout_.node[to_size(owner(static_cast<Index>(i)))][2];
    }
  }

  void number_member(Index m) {
    const Member& member = model_.members[to_size(m)];
    layout_.first_element.push_back(static_cast<Index>(layout_.elements.size()));
    std::array<Index, 2> rotation{-1, -1};
    const bool bends = interpolate(member.section, member.end_section, 0.5).EI > 0;
    for (std::size_t end = 0; end < 2 && bends; ++end) {
      const bool welded = member.ends[end].fixity == EndFixity::welded;
      rotation[end] = welded ? layout_.node[to_size(member.nodes[end])][2] : add(true);
    }
    layout_.end_rotation.push_back(rotation);
    const auto& first = layout_.node[to_size(member.nodes[0])];
    const auto& last = layout_.node[to_size(member.nodes[1])];
    const Vector2d& from = model_.nodes[to_size(member.nodes[0])].position;
    const Vector2d span = model_.nodes[to_size(member.nodes[1])].position - from;
    std::array<Index, 3> left = {first[0], first[1], rotation[0]};
    const double count = static_cast<double>(member.elements);
    for (Index e = 0; e < member.elements; ++e) {
      MemberElement element;
      element.member = m;
      element.start = from + static_cast<double>(e) / count * span;
      element.end = from + static_cast<double>(e + 1) / count * span;
      element.section =
          interpolate(member.section, member.end_section, (static_cast<double>(e) + 0.5) / count);
      if (!bends) {
        element.coordinates = {first[0], first[1], last[0], last[1]};
        layout_.elements.push_back(std::move(element));
        continue;
      }
      element.coordinates.assign(left.begin(), left.end());
      for (int inner = 1; inner < order_; ++inner) {
        for (int k = 0; k < 3; ++k) element.coordinates.push_back(add(k == 2));
      }
      if (e + 1 == member.elements) {
        left = {last[0], last[1], rotation[1]};
      } else {
        for (std::size_t k = 0; k < 3; ++k) left[k] = add(k == 2);
      }
      element.coordinates.insert(element.coordinates.end(), left.begin(), left.end());
      layout_.elements.push_back(std::move(element));
    }
  }

  void number_masses() {
    for (const PointMass& mass : model_.masses) {
      if (mass.offset.isZero(0)) {
        layout_.mass_centre.push_back(
            {layout_.node[to_size(mass.node)][0], layout_.node[to_size(mass.node)][1]});
      } else {
        const Index x = add(false);
        layout_.mass_centre.push_back({x, add(false)});
      }
    }
  }

  /// A constraint that makes two coordinates equal, such as a revolute joint between nodes in one
  /// place, is one coordinate.
  void share_equal() {
    shared_.resize(to_size(layout_.total));
    std::iota(shared_.begin(), shared_.end(), Index{0});
    for (const LinearConstraint& constraint : model_.constraints) {
      const std::optional<std::array<Index, 2>> pair = layout_.equal(constraint);
      if (pair) shared_[to_size(leader((*pair)[0]))] = leader((*pair)[1]);
    }
  }

  Index leader(Index i) const {
    while (shared_[to_size(i)] != i) i = shared_[to_size(i)];
    return i;
  }

  void hold_supports() {
    for (const Support& support : model_.supports) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index coordinate = layout_.node[to_size(support.node)][k];
        if (support.fixed[k] && coordinate >= 0) held_[to_size(leader(coordinate))] = true;
      }
    }
    for (const Drive& drive : scenario_.drives) {
      if (held_[to_size(leader(layout_.node[to_size(drive.node)][to_size(drive.direction)]))]) {
        throw ModelError(part_label("drive", drive.name, 0) + " moves what a support holds");
      }
    }
  }

  void free_first() {
    std::vector<Index> place(to_size(layout_.total), -1);
    Index next = 0;
    for (const bool held : {false, true}) {
      for (Index i = 0; i < layout_.total; ++i) {
        if (leader(i) == i && held_[to_size(i)] == held) place[to_size(i)] = next++;
      }
      if (!held) layout_.free = next;
    }
    std::vector<bool> is_rotation(to_size(next));
    for (Index i = 0; i < layout_.total; ++i) {
      place[to_size(i)] = place[to_size(leader(i))];
      is_rotation[to_size(place[to_size(i)])] = layout_.is_rotation[to_size(i)];
    }
    layout_.total = next;
    layout_.is_rotation = std::move(is_rotation);
    const auto move = [&](Index& i) {
      if (i >= 0) i = place[to_size(i)];
    };
    for (auto& node : layout_.node) {
      for (Index& i : node) move(i);
    }
    for (auto& ends : layout_.end_rotation) {
      for (Index& i : ends) move(i);
    }
    for (MemberElement& element : layout_.elements) {
      for (Index& i : element.coordinates) move(i);
    }
    for (auto& centre : layout_.mass_centre) {
      for (Index& i : centre) move(i);
    }
  }

  const Model& model_;
  const Scenario& scenario_;
  int order_;
  Layout layout_;
  std::vector<Index> owner_;   ///< node whose rotation a node shares
  std::vector<Index> shared_;  ///< coordinate that a coordinate equals
  std::vector<bool> turns_, held_;
};

}  // namespace

Index Layout::of(const Coordinate& coordinate) const {
  if (coordinate.kind == Coordinate::Kind::end_rotation) {
    if (coordinate.member < 0 || to_size(coordinate.member) >= end_rotation.size() ||
        coordinate.end < 0 || coordinate.end > 1) {
      throw ModelError("a constraint names an end of a member that does not exist");
    }
    return end_rotation[to_size(coordinate.member)][to_size(coordinate.end)];
  }
  if (coordinate.node < 0 || to_size(coordinate.node) >= node.size()) {
    throw ModelError("a constraint names a node that does not exist");
  }
  return node[to_size(coordinate.node)][static_cast<std::size_t>(coordinate.kind)];
}

std::optional<std::array<Index, 2>> Layout::equal(const LinearConstraint& constraint) const {
  if (constraint.terms.size() != 2) return std::nullopt;
  const auto& [first, a] = constraint.terms[0];
  const auto& [second, b] = constraint.terms[1];
  const std::array<Index, 2> pair = {of(first), of(second)};
  if (a == 0 || a != -b || pair[0] < 0 || pair[1] < 0) return std::nullopt;
  return pair;
}

Layout number_coordinates(const Model& model, const Scenario& scenario, int order) {
  return Numbering(model, scenario, order).run();
}

}  // namespace trammel::large
