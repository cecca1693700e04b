#pragma once

#include <cstdint>

#include "harness/input/json_view.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::harness {

enum class Weight : std::uint8_t { acts, left_out };

/// A system in the coordinates that an analysis asks for.
struct ReducedSystem {
  solver::Outcome outcome;  ///< of the modes it is reduced to
  solver::System system;
};

/// As the key "reduction" of the analysis says; without it the system as it is.
/// @param weight  whether the analysis lets it act, beside the loads
/// @throws InputError  for a reduction that the system does not allow.
[[nodiscard]] ReducedSystem reduced_system(const JsonView& analysis, solver::System system,
                                           Weight weight = Weight::acts);

}  // namespace trammel::harness
