#pragma once

#include <string>

#include "harness/base/processes.h"
#include "harness/cli/command_run.h"

namespace trammel::harness {

struct GradeCommand {
  std::string command;  ///< the adapter, with arguments
  std::string out = "trammel-grade";
  ProgramLimits limits = {};  ///< of one call
};

/// Lets an adapter's code compute the cases of `run` (the catalogue where it names none), and
/// judges them. @returns 0 where nothing is off, else 1
int grade_command(const GradeCommand& grade, const RunCommand& run, const Renderers& renderers);

}  // namespace trammel::harness
