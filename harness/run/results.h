#pragma once

#include <string>
#include <vector>

#include "harness/results/results.h"
#include "harness/run/run.h"

namespace trammel::harness {

/// What results.json says of the runs.
/// @param with_series  false: of what the store keeps no series and drawings are copied
[[nodiscard]] results::Results results_of(const std::vector<Run>& runs,
                                          const std::vector<Case>& cases,
                                          const References& references, bool with_series = true);

/// Of the case with all that it extends, as its `CaseInfo` has it.
[[nodiscard]] std::string case_hash(const Case& given);

[[nodiscard]] results::Counters counters(const solver::Counters& counters);

/// The series and the drawing alone.
[[nodiscard]] results::Run stored_series(const Computation& computation);

}  // namespace trammel::harness
