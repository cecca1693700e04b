#pragma once

#include <string>

namespace trammel::harness {

/// The paper's claims, and what the results say of each. @returns the exit status
int claims_command(unsigned jobs, bool json);

/// The publication item by item, and which case shows each.
/// @param results  a results.json whose verdicts are shown; empty: none
/// @returns the exit status
int paper_command(const std::string& results, bool json);

}  // namespace trammel::harness
