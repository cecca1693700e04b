#pragma once

#include <string>

namespace trammel::harness {

/// The publication item by item, and which case shows each.
/// @param results  a results.json whose verdicts are shown; empty: none
/// @returns the exit status
int paper_command(const std::string& results);

}  // namespace trammel::harness
