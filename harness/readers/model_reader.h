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

/// Planar structure of a case, without a manipulator.
struct Structure {
  solver::Model model;
  /// Sliders, line springs and follower loads of the case.
  solver::large_motion::LargeMotionModel joints;
};

/// Reads the nodes of a planar model, and the parts that connect the nodes. Indices of new nodes
/// follow those of `given_nodes`.
/// @param model  the JSON object /model of the case
/// @param given_nodes  existing nodes of the manipulator
/// @throws InputError  if a name is unknown or the geometry is impossible.
[[nodiscard]] Structure read_structure(const JsonView& model,
                                       const std::vector<solver::Node>& given_nodes);

/// Reads the manipulator at /model/manipulator of a case.
/// @throws InputError  if the geometry of the manipulator is invalid.
[[nodiscard]] solver::ManipulatorDesign read_manipulator(const JsonView& manipulator);

/// Motion of the platform: a single pose at rest, or the sampled points of a path.
struct PlatformMotion {
  std::optional<solver::Path> path;
  std::vector<solver::TrajectoryPoint> points;
};

/// Reads /model/pose or /model/trajectory.
/// @param model  the JSON object /model of the case
/// @throws InputError  if the manipulator cannot reach a pose.
[[nodiscard]] PlatformMotion read_platform_motion(const JsonView& model,
                                                  const solver::ManipulatorGeometry& geometry);

/// Properties that turn a member of a case into a chain of straight one-element members, AB.1,
/// AB.2, ...
struct MemberChain {
  /// Center of the circle of which the members of the chain are counterclockwise chords [m]; empty:
  /// straight chain.
  std::optional<Eigen::Vector2d> arc_center;
  std::array<bool, 3> held{};  ///< supported motions (x, y, rotation) of all inner nodes

  [[nodiscard]] bool needs_chain() const { return arc_center || held[0] || held[1] || held[2]; }
};

/// Adds a chain of `member.elements` members in place of `member`, with unnamed intermediate nodes
/// and their supports.
/// @param start, end  positions of the member's nodes [m].
/// @param first_node  index of the first intermediate node in the complete model.
/// @throws ModelError  if the two ends have different distances from the center of an arc.
void add_member_chain(const solver::Member& member, const MemberChain& chain,
                      const Eigen::Vector2d& start, const Eigen::Vector2d& end,
                      solver::Index first_node, solver::Model& structure);

}  // namespace trammel::harness
