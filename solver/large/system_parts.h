#pragma once

#include <tuple>
#include <vector>

#include "solver/large/beam.h"
#include "solver/large/element_group.h"
#include "solver/large/joints.h"
#include "solver/large/large_motion_model.h"
#include "solver/large/triangle.h"

namespace trammel::solver::large_motion {

/// Elements and loads of a model.
struct SystemParts {
  std::tuple<ElementGroup<Beam>, ElementGroup<Bar>, ElementGroup<Triangle2d<3>>,
             ElementGroup<Triangle2d<6>>, ElementGroup<CoordinateSpring>, ElementGroup<RigidLink>,
             ElementGroup<SlidingJoint>, ElementGroup<LineSpringElement>,
             ElementGroup<DrivenCoordinate>, ElementGroup<LinearRow>, ElementGroup<FollowerForce>,
             ElementGroup<PointInertia>>
      groups;
  Index rows = 0;  ///< number of constraint rows
  /// Index of each element of a member among the beams, or among the bars if the member is a bar.
  std::vector<Index> group_index;
  VectorXd loads;  ///< dead loads, one per coordinate [N, N m]

  template <class Element>
  [[nodiscard]] const ElementGroup<Element>& group() const {
    return std::get<ElementGroup<Element>>(groups);
  }
  template <class Function>
  void for_each_group(const Function& function) const {
    std::apply([&](const auto&... group) { (function(group), ...); }, groups);
  }
  template <class Function>
  void for_each_group(const Function& function) {
    std::apply([&](auto&... group) { (function(group), ...); }, groups);
  }
};

/// Builds the elements of a model, and numbers the coordinates and constraint rows.
/// @throws ModelError  if the model is invalid. Examples: a triangle has no area; a drive moves a
///   supported or unconnected coordinate; a constraint refers to a missing node or member, or mixes
///   translations and rotations.
[[nodiscard]] SystemParts build_parts(const Model& model, const LargeMotionModel& large_motion,
                                      Layout& layout);

}  // namespace trammel::solver::large_motion
