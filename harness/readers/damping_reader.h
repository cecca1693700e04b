#pragma once

#include "harness/input/json_view.h"
#include "solver/motion/harmonic.h"

namespace trammel::harness {

/// Key "damping" of an analysis; none where it has none.
/// @param modes  how many "all" are, where they are known
/// @throws InputError  for "all" where they are not, more ratios than modes, or numbers without
///                     meaning.
[[nodiscard]] solver::HarmonicDamping read_damping(
    const JsonView& analysis, std::optional<solver::Index> modes = std::nullopt);

}  // namespace trammel::harness
