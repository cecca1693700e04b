#pragma once

#include <tuple>
#include <vector>

#include "solver/large/beam.h"
#include "solver/large/element_group.h"
#include "solver/large/joints.h"
#include "solver/large/large_motion_model.h"
#include "solver/large/triangle.h"

namespace trammel::solver::large_motion {

/// The elements and loads of a model.
struct SystemParts {
  std::tuple<ElementGroup<Beam>, ElementGroup<Bar>, ElementGroup<Triangle2d<3>>,
             ElementGroup<Triangle2d<6>>, ElementGroup<CoordinateSpring>, ElementGroup<RigidLink>,
             ElementGroup<SlidingJoint>, ElementGroup<LineSpringElement>,
             ElementGroup<DrivenCoordinate>, ElementGroup<LinearRow>, ElementGroup<FollowerForce>,
             ElementGroup<PointInertia>>
      groups;
  Index rows = 0;                  ///< number of constraint rows
  std::vector<Index> group_index;  ///< of each element of a member among the beams or the bars
  VectorXd loads;                  ///< dead loads, one a coordinate [N, N m]

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

/// Builds the elements and numbers coordinates and rows.
/// @throws ModelError  where the model has no meaning; if a triangle has no area, a drive moves
///                     what a support holds or a coordinate to which nothing is joined, or a
///                     constraint names a part that does not exist or mixes translations and
///                     rotations.
[[nodiscard]] SystemParts build_parts(const Model& model, const LargeMotionModel& large_motion,
                                      Layout& layout);

}  // namespace trammel::solver::large_motion
