#pragma once

#include <filesystem>
#include <vector>

#include "harness/results/results.h"
#include "harness/run/run.h"

namespace trammel::harness {

/// What results.json says of the runs.
[[nodiscard]] results::Results results_of(const std::vector<Run>& runs,
                                          const std::vector<Case>& cases,
                                          const References& references);

[[nodiscard]] results::Counters counters(const solver::Counters& counters);

/// Writes results.json into the folder, all of it or nothing. @returns its path.
/// @throws InputError  where the folder cannot be made or written.
std::filesystem::path write_results(const results::Results& results,
                                    const std::filesystem::path& folder);

}  // namespace trammel::harness
