#pragma once

#include <array>
#include <vector>

#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// An element of a member with its coordinates along it: (ux, uy, theta) of each node; of a bar
/// (EI = 0) only (ux, uy) of its ends.
struct MemberElement {
  Index member = 0;
  Vector2d start = Vector2d::Zero();  ///< in the model's pose [m]
  Vector2d end = Vector2d::Zero();
  Section section;
  std::vector<Index> coordinates;
  [[nodiscard]] bool is_bar() const { return coordinates.size() == 4; }
  [[nodiscard]] double length() const { return (end - start).norm(); }
  /// Coordinates of a node.
  [[nodiscard]] std::size_t stride() const { return is_bar() ? 2 : 3; }
  [[nodiscard]] std::size_t nodes() const { return coordinates.size() / stride(); }
  /// Position of a node in the model's pose [m].
  [[nodiscard]] Vector2d position(std::size_t node) const;
};

/// Numbers the coordinates: the free ones first, then those that supports hold, so that an index at
/// or above `free` means a displacement of zero. Joints share coordinates where they can: a
/// revolute joint shares translations (so does a constraint that makes two coordinates equal), a
/// welded end and a rigid body's nodes share the rotation.
struct Layout {
  Index free = 0;
  Index total = 0;
  std::vector<std::array<Index, 3>> node;          ///< x, y, rotation (-1: the node has none)
  std::vector<std::array<Index, 2>> end_rotation;  ///< of each member's ends
  std::vector<MemberElement> elements;
  std::vector<Index> first_element;  ///< of each member, one past the last at the end
  std::vector<std::array<Index, 2>>
      mass_centre;             ///< of each point mass with an offset; else node's
  std::vector<int> direction;  ///< of each coordinate: 0: x, 1: y, 2: rotation

  [[nodiscard]] bool is_rotation(Index coordinate) const {
    return direction[static_cast<std::size_t>(coordinate)] == 2;
  }
};

}  // namespace trammel::solver::large_motion
