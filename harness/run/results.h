#pragma once

#include <filesystem>
#include <vector>

#include "harness/run/run.h"

namespace trammel::harness {

/// results.json of the runs, by cases/schema/results.schema.json. Numbers that are not finite are
/// null.
[[nodiscard]] Json results_of(const std::vector<Run>& runs, const std::vector<Case>& cases,
                              const References& references);

/// Writes results.json into the folder, all of it or nothing. @returns its path.
/// @throws InputError  where the folder cannot be made or written.
std::filesystem::path write_results(const Json& results, const std::filesystem::path& folder);

/// Makes the folder and finds out whether files can be written there, before hours are spent.
/// @throws InputError
void require_writable(const std::filesystem::path& folder);

}  // namespace trammel::harness
