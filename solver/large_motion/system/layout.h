#pragma once

#include <array>
#include <optional>
#include <vector>

#include "solver/large_motion/elements/large_motion_model.h"
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
      mass_centre;                ///< of each point mass with an offset; else node's
  std::vector<bool> is_rotation;  ///< of each coordinate

  [[nodiscard]] Index index_of(const Coordinate& coordinate) const;
  /// The two coordinates that a constraint makes equal, if it is of that kind.
  [[nodiscard]] std::optional<std::array<Index, 2>> equated_coordinates(
      const LinearConstraint& constraint) const;
};

/// @param order  degree of the beam elements, 1 to 3.
/// @throws ModelError  where the model has no meaning.
[[nodiscard]] Layout number_coordinates(const Model& model, const LargeMotionModel& large_motion,
                                        int order);

}  // namespace trammel::solver::large_motion
