#pragma once

#include <array>
#include <optional>
#include <vector>

#include "harness/input/json_view.h"
#include "solver/large/large_motion_model.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// The planar part of a case's model.
struct Structure {
  solver::Model model;
  /// Sliders, springs along a line and follower loads.
  solver::large_motion::LargeMotionModel joints;
};

/// Reads the nodes of a planar model and what joins them. Indices count `before` first.
/// @param model   the place /model
/// @param before  nodes that are already there, from the manipulator
/// @throws InputError  where a name leads nowhere or geometry is impossible.
[[nodiscard]] Structure read_structure(const JsonView& model,
                                       const std::vector<solver::Node>& before);

/// Reads the place /model/manipulator.
/// @throws InputError  where its geometry has no meaning.
[[nodiscard]] solver::ManipulatorDesign read_manipulator(const JsonView& manipulator);

/// One pose at rest, or the points of a path.
struct PlatformMotion {
  std::optional<solver::Path> path;
  std::vector<solver::TrajectoryPoint> points;
};

/// Reads /model/pose or /model/trajectory.
/// @param model  the place /model
/// @throws InputError  where a pose is out of reach.
[[nodiscard]] PlatformMotion read_platform_motion(const JsonView& model,
                                                  const solver::ManipulatorGeometry& geometry);

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
