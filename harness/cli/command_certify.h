#pragma once

#include <string>
#include <vector>

#include "harness/cli/command_run.h"

namespace trammel::harness {

/// How much verdicts and digits depend on the rounding of the solver and on who built it.
/// @param builds  results.json of the same cases, or their folders
/// @returns the exit status: 1 where a verdict differs
int certify_command(const RunCommand& command, const std::vector<std::string>& builds);

}  // namespace trammel::harness
