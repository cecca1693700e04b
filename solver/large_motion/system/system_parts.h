#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "solver/large_motion/system/element_group.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

class FollowerLoads;

/// What the parts of a model contribute to the equations of `GeometricallyExactSystem`. Built part
/// by part by the functions of member_elements.h, energy_elements.h, joint_elements.h,
/// linear_constraints.h and loads.h.
struct SystemParts {
  std::vector<std::unique_ptr<ElementGroup>> groups;
  Index rows = 0;                  ///< constraint rows so far
  std::vector<Index> element_row;  ///< first row of each element of a member
  Index first_drive_row = 0;
  const FollowerLoads* follower_loads = nullptr;     ///< among the groups; null: none
  std::vector<std::pair<Index, double>> point_mass;  ///< on one coordinate [kg or kg m^2]
  std::vector<Eigen::Triplet<double>> mass_entries;  ///< of elements [kg, kg m, kg m^2]
  VectorXd loads;                                    ///< dead loads, one a coordinate [N, N m]

  /// Keeps a group that has elements; its rows come after those of the groups before it.
  void add(std::unique_ptr<ElementGroup> group) {
    rows += group->rows();
    if (group->size() > 0) groups.push_back(std::move(group));
  }

  /// Adds the mass matrix of an element.
  template <int N>
  void add_mass(const Eigen::Matrix<double, N, N>& mass, const std::array<Index, N>& coordinates) {
    for (int i = 0; i < N; ++i) {
      for (int j = 0; j < N; ++j) {
        if (mass(i, j) == 0) continue;
        mass_entries.emplace_back(coordinates[to_size(i)], coordinates[to_size(j)], mass(i, j));
      }
    }
  }
};

}  // namespace trammel::solver::large_motion
