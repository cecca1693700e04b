#pragma once

#include <string>

#include "harness/cli/command_run.h"

namespace trammel::harness {

/// What calls kept in a history came to, what changed since the last green one, and slow drifts.
/// @returns the exit status: 1 where the newest call has failures
int history_command(const std::string& file, bool json);

struct SlowerCommand {
  std::string program;      ///< another build
  std::size_t repeats = 0;  ///< 0: as many as so many cases need
  bool json = false;
};

/// Times this program against another on cases, in interleaved repeats, and tells what is slower
/// from noise. @returns the exit status: 1 where a case is slower
int slower_command(const SlowerCommand& command, const RunCommand& selection);

}  // namespace trammel::harness
