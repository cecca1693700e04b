#pragma once

#include <cstdint>

#include "harness/input/json_view.h"
#include "solver/linear/system.h"
#include "solver/model/evidence.h"

namespace trammel::harness {

/// Selects whether the weight of the parts acts in addition to the loads.
enum class Weight : std::uint8_t { acts, left_out };

/// System of equations, possibly reduced to component modes or natural modes.
struct ReducedSystem {
  solver::Outcome outcome;  ///< outcome of computing the modes to which the system is reduced
  solver::System system;
};

/// Reduces the system as the key "reduction" of the analysis requests. Without this key, returns
/// the system unchanged.
/// @param weight  whether the weight acts in addition to the loads
/// @throws InputError  for a reduction that the system does not allow.
[[nodiscard]] ReducedSystem reduced_system(const JsonView& analysis, solver::System system,
                                           Weight weight = Weight::acts);

}  // namespace trammel::harness
