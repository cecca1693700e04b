#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Functions and programs in separate processes: a crash, an endless loop or too much memory costs
/// one of them.
namespace trammel::harness {

struct ProcessTask {
  std::function<std::string()> work;  ///< its answer
  unsigned cpu_limit_s = 0;           ///< processor time; at least 1
};

/// How a process ended.
struct ProcessOutcome {
  enum class Termination { answered, timed_out, out_of_memory, disk_full, crashed, not_started };
  Termination termination = Termination::not_started;
  /// Answer of a function, or the reason why there is none. For a program the end of standard
  /// output and error, at most 64 KiB.
  std::string text;
  int status = 0;  ///< exit status, number of the signal, or errno if it was not started
  double wall_s = 0, cpu_s = 0;
};

struct ProcessOptions {
  unsigned at_once = 1;
  std::size_t memory_bytes = 0;  ///< address space of each; 0: no limit, as always under sanitizers
  std::function<void()> waiting = {};  ///< called about once a second while none ends
};

/// Where memory runs out and nobody catches it (JSON allocates in a destructor, which lets nothing
/// out), this process ends with that status and line on standard error.
void end_without_memory(int status, const char* line);

/// What this process may take: what `run_in_processes` allows it, else half of the least of the
/// machine's memory, that of its group (cgroup) and its address space.
[[nodiscard]] std::size_t memory_limit_bytes();

/// Does each task in a process that is forked from this one, which must have no second thread.
/// Where the system has no room for another process, those under way are awaited first.
/// @param ended  called here as each one ends, in any order
/// @returns SIGINT or SIGTERM where one came: those under way are dropped, the rest is not started;
///          else 0
[[nodiscard]] int run_in_processes(
    const std::vector<ProcessTask>& tasks, const ProcessOptions& options,
    const std::function<void(std::size_t task, const ProcessOutcome& outcome)>& ended);

/// Runs one function.
/// @throws Interrupted  if SIGINT or SIGTERM came
[[nodiscard]] ProcessOutcome run_limited(const ProcessTask& task, const ProcessOptions& options);

/// Limits of a program that is not part of trammel.
struct ProgramLimits {
  double wall_s = 120;
  std::size_t memory_bytes = 0;  ///< address space of each of its processes; 0: no limit
  std::size_t disk_bytes = std::size_t{1} << 30;  ///< of each file, and of its folder as a whole
};

/// Runs a program in the folder, which is also its TMPDIR, in a separate session and without
/// standard input; then kills it with all that it has started. It is `answered` with any exit
/// status. This process must have no other children.
/// @param words  the program's path, then its arguments
[[nodiscard]] ProcessOutcome run_limited(const std::vector<std::string>& words,
                                         const std::filesystem::path& folder,
                                         const ProgramLimits& limits);

/// Makes this process the parent of what its descendants leave behind, from now on.
void adopt_descendants();
/// Kills every child of this process, and what becomes its child by that.
void end_descendants();

/// Size of all files below a folder; counting stops above `enough`.
[[nodiscard]] std::size_t folder_bytes(const std::filesystem::path& folder, std::size_t enough);

/// From now on SIGINT and SIGTERM, where `run_in_processes` does not read them, end the program
/// with this line on standard error and exit status 128 + signal. Where they were ignored they
/// still are.
void end_on_signals(const std::string& line);

}  // namespace trammel::harness
