#pragma once

#include <sys/resource.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

/// Computations in processes of their own: a crash, an endless loop or too much memory costs one of
/// them, never the others.
namespace trammel::harness {

struct ProcessTask {
  std::function<std::string()> work;  ///< its answer
  unsigned cpu_limit_s = 0;           ///< processor time; at least 1
};

/// How a process ended.
struct ProcessOutcome {
  enum class Termination { answered, timed_out, out_of_memory, crashed, not_started };
  Termination termination = Termination::crashed;
  std::string text;  ///< the answer, or the reason why there is none
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

/// Processor time of the system and of the program itself.
[[nodiscard]] double cpu_time_s(const rusage& used);

/// From now on SIGINT and SIGTERM, where `run_in_processes` does not read them, end the program
/// with this line on standard error and exit status 128 + signal. Where they were ignored they
/// still are.
void end_on_signals(const std::string& line);

}  // namespace trammel::harness
