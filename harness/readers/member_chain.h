#pragma once

#include <array>
#include <optional>

#include "solver/model/model.h"

namespace trammel::harness {

/// What makes one member of a case a chain of straight members of one element, AB.1, AB.2, ...
struct MemberChain {
  std::optional<Eigen::Vector2d> arc_center;  ///< chords of a circle, counterclockwise [m]
  std::array<bool, 3> held{};                 ///< x, y, rotation of every node between the ends

  [[nodiscard]] bool needed() const { return arc_center || held[0] || held[1] || held[2]; }
};

/// Adds the chain of `member.elements` members that stands for `member`, the nodes between them
/// (without names) and what holds those.
/// @param start, end  positions of the member's nodes [m]
/// @param first_node  the index that the next of `structure.nodes` has in the model
/// @throws ModelError  where the two ends are not as far from the centre of an arc.
void add_chain(const solver::Member& member, const MemberChain& chain, const Eigen::Vector2d& start,
               const Eigen::Vector2d& end, solver::Index first_node, solver::Model& structure);

}  // namespace trammel::harness
