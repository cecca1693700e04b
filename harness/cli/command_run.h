#pragma once

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include "harness/base/processes.h"
#include "harness/cli/command_line.h"
#include "harness/input/case.h"

namespace trammel::harness {

struct RunCommand {
  std::vector<std::string> cases;   ///< names or files
  std::vector<std::string> labels;  ///< beside them
  std::string variant;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::string out = "trammel-results";
  std::string store;  ///< folder; empty: in `out`
  bool resume = false;
  std::size_t memory_bytes = memory_limit_bytes();  ///< of one run; 0: no limit
  std::string shard;                                ///< "K/N": only that part, for `trammel merge`
  std::string costs;                                ///< results.json that shards are balanced by
  bool any_machine = false;                         ///< resumes also with times of another machine
  std::string history;        ///< SQLite file that the call is added to; empty: none
  bool single_file = false;   ///< of a report, beside its pages
  bool json = false;          ///< results.json instead of tables
  bool measurements = false;  ///< also as lines that ctest sends to CDash
  bool vtk = false;           ///< drawings also as files of VTK
};

/// The cases that are named, and those with the labels; the whole catalogue where there are
/// neither.
/// @throws InputError  where one of them cannot be read.
[[nodiscard]] std::vector<Case> select_cases(const RunCommand& command);
/// Computes cases and judges them. @returns the exit status
int run_command(const RunCommand& command, const Renderers& renderers);
/// The page of the whole catalogue with its cost studies and claims, of the cases named, or of
/// results files.
int report_command(const RunCommand& command, const Renderers& renderers);

}  // namespace trammel::harness
