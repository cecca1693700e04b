#pragma once

#include <string>
#include <vector>

#include "harness/cli/command_line.h"

namespace trammel::harness {

struct RunCommand {
  std::vector<std::string> cases;   ///< names or files
  std::vector<std::string> labels;  ///< beside them
  std::string variant;
  unsigned jobs = 1;
  std::string out;
  std::string store = {};  ///< folder; empty: in `out`
  bool resume = false;
  std::size_t memory_bytes = 0;  ///< of one run; 0: no limit
};

/// Computes cases and judges them. @returns the exit status
int run_command(const RunCommand& command, const Renderers& renderers);
/// The page of the whole catalogue with its cost studies and claims, or of the cases named.
int report_command(const RunCommand& command, const Renderers& renderers);

}  // namespace trammel::harness
