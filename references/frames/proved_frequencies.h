#pragma once

#include <string>
#include <vector>

#include "references/frames/frame.h"

/// Natural frequencies as proved enclosures: the count of Wittrick and Williams in ball arithmetic
/// is an integer that no rounding can change, and what lies between two counts that differ by m are
/// m frequencies. What a proof rests on: the theorem, the formulas of `member_dynamics.h` and Arb.
namespace trammel::references {

/// The first `count` elastic frequencies [Hz], each within a unit of its 30th digit, and none
/// missed between or below them.
/// @throws DerivationError  where that cannot be proved, or as `frame_frequencies`.
[[nodiscard]] std::vector<std::string> proved_frequencies(const Frame& frame, int count);

/// The same of beta L = sqrt(w) of a beam of unit length, mass and bending stiffness.
[[nodiscard]] std::vector<std::string> proved_wave_numbers(const Frame& unit_beam, int count);

}  // namespace trammel::references
