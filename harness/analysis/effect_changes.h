#pragma once

#include <map>
#include <string>

#include "harness/base/quantity.h"
#include "harness/base/statistic.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Returns the distance between the end nodes of a member [m].
[[nodiscard]] double member_length(const solver::Model& model, const solver::Member& member);

/// Length, force and displacement of a model, estimated from its nodes, loads and stiffness; zero
/// if unknown. Changes are relative to these magnitudes if the values of a quantity are all zero up
/// to round-off.
struct ModelScales {
  double length = 0;  ///< twice the largest distance of a node from the mean node [m]
  double force = 0;   ///< sum of the magnitudes of loads, and of moments / length [N]
  /// Elongation of a bar under `force` [m]. The bar has this `length` and the largest axial
  /// stiffness of the model.
  double displacement = 0;
};
[[nodiscard]] ModelScales typical_model_scales(const solver::Model& model);

/// Returns the scale of the changes of each group of quantities, such as forces. The scale is the
/// largest value of the group, or the round-off error of the group if the round-off error is
/// larger.
[[nodiscard]] std::map<std::string, double> change_scales(const Quantities& full,
                                                          const ModelScales& model);
/// Largest relative change of each group of quantities, by the name of the group. Changes of
/// "displacement", "force", "stress" and similar groups are relative to the largest value of the
/// group. Changes of "frequency" are relative to each frequency, and infinite if modes are missing.
/// The two components of a vector are compared as one vector. Quantities without a group are not
/// compared, nor are quantities that only one of the two results contains, such as rotations of a
/// rigid platform.
using Changes = std::map<std::string, LargestDifference>;
[[nodiscard]] Changes result_changes(const Quantities& full, const Quantities& other,
                                     const ModelScales& model);
[[nodiscard]] LargestDifference max_change(const Changes& changes);

/// Returns the group of quantities that share a scale with this quantity, such as "displacement" or
/// "force"; empty if changes of the quantity are not compared.
[[nodiscard]] std::string quantity_group(const std::string& quantity);

}  // namespace trammel::harness
