#pragma once

#include <string>

namespace trammel::harness {

struct CoverageCommand {
  std::string results;  ///< a results.json whose series are counted; empty: none
  bool gaps = false;    ///< only what has no independent evidence
  bool json = false;
};

/// What is verified by what kind of evidence.
/// @returns the exit status: 1 where there is none and no reason is recorded
int coverage_command(const CoverageCommand& command);

}  // namespace trammel::harness
