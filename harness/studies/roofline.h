#pragma once

#include "harness/results/cost_results.h"

namespace trammel::harness {

/// What one core of this machine does at most, by a loop of multiplications and additions and by
/// one that only moves numbers, and what the solver's inner loops reach of it: operations and bytes
/// are counted from sizes, times measured. Takes about a second.
[[nodiscard]] results::Roofline measure_roofline();

}  // namespace trammel::harness
