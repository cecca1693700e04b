#pragma once

#include <vector>

#include "harness/judge/sweep.h"

namespace trammel::harness {

/// Computes all levels of all sweeps of a case or variant.
/// @throws InputError  where the values do not go from coarse to fine.
[[nodiscard]] std::vector<Sweep> run_sweeps(const Document& document, const References& references);

}  // namespace trammel::harness
