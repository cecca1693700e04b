#pragma once

#include <map>
#include <string>

#include "harness/base/quantity.h"
#include "harness/base/statistic.h"

namespace trammel::harness {

/// Largest change of each kind of quantity: "displacement", "rotation", "force", "moment",
/// "stress", each relative to the largest of its kind, and "frequency", each relative to itself.
/// Infinite where modes are lost. Quantities that one side does not have, as rotations of a rigid
/// platform, and those of other kinds are not compared.
using Changes = std::map<std::string, LargestDifference>;
[[nodiscard]] Changes changes_between(const Quantities& full, const Quantities& other,
                                      double size_m);
[[nodiscard]] LargestDifference max_change(const Changes& changes);

/// What a quantity is compared among; empty: it is not compared.
[[nodiscard]] std::string change_kind(const std::string& quantity);

}  // namespace trammel::harness
