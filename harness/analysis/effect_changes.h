#pragma once

#include <map>
#include <string>

#include "harness/base/quantity.h"
#include "harness/base/statistic.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Returns the distance between the end nodes of a member [m].
[[nodiscard]] double member_length(const solver::Model& model, const solver::Member& member);

/// Magnitudes that loads and stiffness of a model imply. They bound the round-off error of a group
/// of quantities whose values are all zero up to round-off. Zero if unknown.
struct ModelScales {
  double length = 0;        ///< diameter of the nodes about their mean, independent of the axes [m]
  double force = 0;         ///< sum of the magnitudes of all loads, moments over the length [N]
  double displacement = 0;  ///< elongation of the stiffest member under that force, over the length
                            ///< [m]
};
[[nodiscard]] ModelScales scales_of(const solver::Model& model);

/// Returns the scale of the changes of each group of quantities: its largest value, but at least
/// the round-off error that forces and displacements of the model cause.
[[nodiscard]] std::map<std::string, double> change_scales(const Quantities& full,
                                                          const ModelScales& model);
/// Largest change of each kind of quantity. "displacement", "rotation", "force", "moment" and
/// "stress" are relative to the largest value of the kind. "frequency" is relative to each
/// frequency. The two components of a vector are compared as one vector. The change is infinite if
/// modes are lost. Quantities of other kinds are not compared, nor are quantities that only one
/// side has, such as rotations of a rigid platform.
using Changes = std::map<std::string, LargestDifference>;
[[nodiscard]] Changes changes_between(const Quantities& full, const Quantities& other,
                                      const ModelScales& model);
[[nodiscard]] LargestDifference max_change(const Changes& changes);

/// Returns the group of quantities that share a scale with this quantity, such as "displacement" or
/// "force"; empty if changes of the quantity are not compared.
[[nodiscard]] std::string quantity_group(const std::string& quantity);

}  // namespace trammel::harness
