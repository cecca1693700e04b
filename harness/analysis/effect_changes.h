#pragma once

#include <map>
#include <string>

#include "harness/base/quantity.h"
#include "harness/base/statistic.h"
#include "solver/model/model.h"

namespace trammel::harness {

/// Distance between the nodes of a member [m].
[[nodiscard]] double member_length(const solver::Model& model, const solver::Member& member);

/// Scales of a model's kinds of quantities, from which the round-off error of each follows where
/// its own observed values are all round-off. Zero if nothing is known.
struct ModelScales {
  double length = 0;        ///< diameter about the mean of the nodes, in any axes [m]
  double force = 0;         ///< sum of the magnitudes of all loads, moments over the length [N]
  double displacement = 0;  ///< that force stretches the stiffest member over the length by [m]
};
[[nodiscard]] ModelScales scales_of(const solver::Model& model);

/// Scales that changes of each kind are relative to: its largest value, and never less than the
/// round-off error that forces and displacements of the model leave in it.
[[nodiscard]] std::map<std::string, double> change_scales(const Quantities& full,
                                                          const ModelScales& model);
/// Largest change of each kind of quantity: "displacement", "rotation", "force", "moment",
/// "stress", each relative to the largest of its kind, and "frequency", each relative to itself.
/// The two components of a vector are compared as one. Infinite where modes are lost. Quantities
/// that one side does not have, as rotations of a rigid platform, and those of other kinds are not
/// compared.
using Changes = std::map<std::string, LargestDifference>;
[[nodiscard]] Changes changes_between(const Quantities& full, const Quantities& other,
                                      const ModelScales& model);
[[nodiscard]] LargestDifference max_change(const Changes& changes);

/// What a quantity is compared among; empty: it is not compared.
[[nodiscard]] std::string change_kind(const std::string& quantity);

}  // namespace trammel::harness
