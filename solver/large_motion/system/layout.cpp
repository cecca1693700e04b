#include "solver/large_motion/system/layout.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "solver/elements/frame_element.h"
#include "solver/large_motion/elements/beam.h"
#include "solver/model/labels.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// Sets of parts or coordinates that are one, each named by one of them.
class MergedSets {
 public:
  explicit MergedSets(Index count) : parent_(to_size(count)) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  [[nodiscard]] Index find(Index i) const {
    while (parent_[to_size(i)] != i) i = parent_[to_size(i)];
    return i;
  }
  /// The set of `second` also names that of `first`.
  void merge(Index first, Index second) { parent_[to_size(find(first))] = find(second); }

 private:
  std::vector<Index> parent_;
};

class Numbering {
 public:
  Numbering(const Model& model, const LargeMotionModel& large_motion)
      : model_(model), large_motion_(large_motion), owner_(std::ssize(model.nodes)) {}

  Layout run() {
    share_rotations();
    find_rotations();
    number_nodes();
    for (Index m = 0; m < static_cast<Index>(model_.members.size()); ++m) number_member(m);
    layout_.first_element.push_back(static_cast<Index>(layout_.elements.size()));
    number_masses();
    merge_equated();
    apply_supports();
    renumber_free_first();
    return std::move(layout_);
  }

 private:
  void share_rotations() {
    for (const RigidBody& body : model_.rigid_bodies) {
      for (const Index node : body.attached) owner_.merge(node, body.reference);
    }
  }

  void find_rotations() {
    has_rotation_.assign(model_.nodes.size(), false);
    const auto require_rotation = [&](Index node) {
      if (node >= 0) has_rotation_[to_size(owner_.find(node))] = true;
    };
    for (const Member& member : model_.members) {
      for (std::size_t end = 0; end < 2; ++end) {
        if (member.ends[end].fixity != EndFixity::hinged) require_rotation(member.nodes[end]);
      }
    }
    for (const RigidBody& body : model_.rigid_bodies) require_rotation(body.reference);
    for (const PointMass& mass : model_.masses) {
      if (mass.inertia != 0 || !mass.offset.isZero(0)) require_rotation(mass.node);
    }
    for (const Spring& spring : model_.springs) {
      if (spring.stiffness[2] != 0) require_rotation(spring.nodes[0]);
      if (spring.stiffness[2] != 0) require_rotation(spring.nodes[1]);
    }
    for (const NodalLoad& load : model_.loads) {
      if (load.force[2] != 0) require_rotation(load.node);
    }
    for (const LinearConstraint& constraint : model_.constraints) {
      for (const auto& [coordinate, factor] : constraint.terms) {
        if (coordinate.kind == Coordinate::Kind::rotation) require_rotation(coordinate.node);
      }
    }
    for (const Drive& drive : large_motion_.drives) {
      if (drive.direction != 2) continue;
      require_rotation(drive.node);
      require_rotation(drive.from);
    }
    for (const Torque& torque : large_motion_.torques) require_rotation(torque.node);
    for (const FollowerLoad& load : large_motion_.follower_loads) require_rotation(load.node);
    for (const Slider& slider : large_motion_.sliders) {
      require_rotation(slider.rail);
      if (slider.keeps_angle) require_rotation(slider.node);
    }
  }

  Index add(int direction) {
    layout_.direction.push_back(direction);
    fixed_.push_back(false);
    return layout_.total++;
  }

  void number_nodes() {
    layout_.node.assign(model_.nodes.size(), {-1, -1, -1});
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      layout_.node[i][0] = add(0);
      layout_.node[i][1] = add(1);
      if (has_rotation_[i] && owner_.find(static_cast<Index>(i)) == static_cast<Index>(i)) {
        layout_.node[i][2] = add(2);
      }
    }
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      layout_.node[i][2] = layout_.node[to_size(owner_.find(static_cast<Index>(i)))][2];
    }
  }

  /// Rotations of a member's two ends; -1 where the member does not bend.
  std::array<Index, 2> number_end_rotations(const Member& member, bool bends) {
    std::array<Index, 2> rotation{-1, -1};
    for (std::size_t end = 0; end < 2 && bends; ++end) {
      const bool welded = member.ends[end].fixity == EndFixity::welded;
      rotation[end] = welded ? layout_.node[to_size(member.nodes[end])][2] : add(2);
    }
    return rotation;
  }

  void number_member(Index m) {
    const Member& member = model_.members[to_size(m)];
    layout_.first_element.push_back(static_cast<Index>(layout_.elements.size()));
    const bool bends = section_at(member, 0.5).EI > 0;
    const std::array<Index, 2> rotation = number_end_rotations(member, bends);
    layout_.end_rotation.push_back(rotation);
    const auto& first = layout_.node[to_size(member.nodes[0])];
    const auto& last = layout_.node[to_size(member.nodes[1])];
    std::array<Index, 3> left = {first[0], first[1], rotation[0]};
    for (Index e = 0; e < member.elements; ++e) {
      MemberElement element = unnumbered_element(m, e);
      if (!bends) {
        element.coordinates = {first[0], first[1], last[0], last[1]};
        layout_.elements.push_back(std::move(element));
        continue;
      }
      element.coordinates.assign(left.begin(), left.end());
      for (int inner = 2; inner < BeamInterpolation::kNodes; ++inner) {
        for (int k = 0; k < 3; ++k) element.coordinates.push_back(add(k));
      }
      if (e + 1 == member.elements) {
        left = {last[0], last[1], rotation[1]};
      } else {
        for (int k = 0; k < 3; ++k) left[static_cast<std::size_t>(k)] = add(k);
      }
      element.coordinates.insert(element.coordinates.end(), left.begin(), left.end());
      layout_.elements.push_back(std::move(element));
    }
  }

  /// Element e of member m with its ends and the section at its middle.
  [[nodiscard]] MemberElement unnumbered_element(Index m, Index e) const {
    const Member& member = model_.members[to_size(m)];
    const Vector2d& from = model_.nodes[to_size(member.nodes[0])].position;
    const Vector2d span = model_.nodes[to_size(member.nodes[1])].position - from;
    const double count = static_cast<double>(member.elements);
    MemberElement element;
    element.member = m;
    element.start = from + static_cast<double>(e) / count * span;
    element.end = from + static_cast<double>(e + 1) / count * span;
    element.section = section_at(member, (static_cast<double>(e) + 0.5) / count);
    return element;
  }

  void number_masses() {
    for (const PointMass& mass : model_.masses) {
      if (mass.offset.isZero(0)) {
        layout_.mass_centre.push_back(
            {layout_.node[to_size(mass.node)][0], layout_.node[to_size(mass.node)][1]});
      } else {
        const Index x = add(0);
        layout_.mass_centre.push_back({x, add(1)});
      }
    }
  }

  /// A constraint that makes two coordinates equal, such as a revolute joint between nodes in one
  /// place, is one coordinate.
  void merge_equated() {
    representative_ = MergedSets(layout_.total);
    for (const LinearConstraint& constraint : model_.constraints) {
      const std::optional<std::array<Index, 2>> pair = layout_.equated_coordinates(constraint);
      if (pair) representative_.merge((*pair)[0], (*pair)[1]);
    }
  }

  void apply_supports() {
    for (const Support& support : model_.supports) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Index coordinate = layout_.node[to_size(support.node)][k];
        if (support.fixed[k] && coordinate >= 0)
          fixed_[to_size(representative_.find(coordinate))] = true;
      }
    }
    for (const Drive& drive : large_motion_.drives) {
      if (fixed_[to_size(
              representative_.find(layout_.node[to_size(drive.node)][to_size(drive.direction)]))]) {
        throw ModelError(part_label("drive", drive.name, 0) + " moves what a support holds");
      }
    }
  }

  void renumber_free_first() {
    std::vector<Index> new_index(to_size(layout_.total), -1);
    Index next = 0;
    for (const bool fixed : {false, true}) {
      for (Index i = 0; i < layout_.total; ++i) {
        if (representative_.find(i) == i && fixed_[to_size(i)] == fixed)
          new_index[to_size(i)] = next++;
      }
      if (!fixed) layout_.free = next;
    }
    std::vector<int> direction(to_size(next));
    for (Index i = 0; i < layout_.total; ++i) {
      new_index[to_size(i)] = new_index[to_size(representative_.find(i))];
      direction[to_size(new_index[to_size(i)])] = layout_.direction[to_size(i)];
    }
    layout_.total = next;
    layout_.direction = std::move(direction);
    const auto renumber = [&](auto& coordinates) {
      for (Index& i : coordinates) i = i < 0 ? i : new_index[to_size(i)];
    };
    std::ranges::for_each(layout_.node, renumber);
    std::ranges::for_each(layout_.end_rotation, renumber);
    std::ranges::for_each(layout_.mass_centre, renumber);
    for (MemberElement& element : layout_.elements) renumber(element.coordinates);
  }

  const Model& model_;
  const LargeMotionModel& large_motion_;
  Layout layout_;
  MergedSets owner_;              ///< nodes that share a rotation
  MergedSets representative_{0};  ///< coordinates that are equal
  std::vector<bool> has_rotation_, fixed_;
};

}  // namespace

Vector2d MemberElement::position(std::size_t node) const {
  const double x = is_bar() ? static_cast<double>(node) : beam_interpolation().node[node];
  return start + x * (end - start);
}

Index Layout::index_of(const Coordinate& coordinate) const {
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

std::optional<std::array<Index, 2>> Layout::equated_coordinates(
    const LinearConstraint& constraint) const {
  if (constraint.terms.size() != 2) return std::nullopt;
  const auto& [first, a] = constraint.terms[0];
  const auto& [second, b] = constraint.terms[1];
  const std::array<Index, 2> pair = {index_of(first), index_of(second)};
  if (a == 0 || a != -b || pair[0] < 0 || pair[1] < 0) return std::nullopt;
  return pair;
}

Layout number_coordinates(const Model& model, const LargeMotionModel& large_motion) {
  return Numbering(model, large_motion).run();
}

}  // namespace trammel::solver::large_motion
