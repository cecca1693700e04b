#pragma once

#include <filesystem>

#include "harness/results/side_comparison.h"

namespace trammel::reports {

/// Writes sides beside each other as one page that needs no other file: what changed, time and
/// accuracy, modes and numbers, and the curves of the runs that change most over each other.
/// @throws std::runtime_error  where a figure cannot be drawn or the file not be written
void write_comparison(const results::SideComparison& comparison, const std::filesystem::path& file);

}  // namespace trammel::reports
