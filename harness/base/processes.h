#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Runs functions and programs in separate processes. A crash, an endless loop or excessive memory
/// use of one process therefore does not affect other processes.
namespace trammel::harness {

struct ProcessTask {
  std::function<std::string()> work;  ///< computes the answer of the task
  unsigned cpu_limit_s = 0;           ///< limit of processor time; at least 1
};

/// Result of a child process: the cause of its end, its answer and its computing times.
struct ProcessOutcome {
  enum class Termination { answered, timed_out, out_of_memory, disk_full, crashed, not_started };
  Termination termination = Termination::not_started;
  /// Text returned by a function, or the reason why the function did not return. For a program: the
  /// end of its standard output and error, at most 64 KiB.
  std::string text;
  int status = 0;  ///< exit status, signal number, or errno if the process was not started
  double wall_s = 0, cpu_s = 0;
};

struct ProcessOptions {
  unsigned at_once = 1;  ///< maximum number of simultaneous processes
  /// Limit of the address space of each process [bytes]; 0: no limit. Processes under sanitizers
  /// have no limit.
  std::size_t memory_bytes = 0;
  std::function<void()> waiting = {};  ///< called about once a second while processes run
};

/// Sets the exit status and the line on standard error for an allocation failure that no code
/// catches. An example is a failure in a destructor of the JSON library.
void set_exit_on_out_of_memory(int status, const char* line);

/// Returns the memory limit of this process [bytes]: the limit set by `run_in_worker_processes`,
/// else half of the smallest of machine memory, cgroup limit and address space.
[[nodiscard]] std::size_t memory_limit_bytes();

/// Runs the tasks in worker processes forked from this process, which must have a single thread.
/// Each worker runs one task after another. If a worker ends while tasks are waiting, another
/// worker is started. If the system cannot start another process, the running workers run all
/// tasks.
/// @param ended  called in this process when a task ends; tasks end in any order
/// @returns SIGINT or SIGTERM if one of these signals was received, else 0. After a signal, running
///   tasks are killed and waiting tasks are not started.
[[nodiscard]] int run_in_worker_processes(
    const std::vector<ProcessTask>& tasks, const ProcessOptions& options,
    const std::function<void(std::size_t task, const ProcessOutcome& outcome)>& ended);

/// Runs one function in a separate process with the limits of `options`.
/// @throws Interrupted  if SIGINT or SIGTERM was received.
[[nodiscard]] ProcessOutcome run_limited(const ProcessTask& task, const ProcessOptions& options);

/// Resource limits of an external program.
struct ProgramLimits {
  double wall_s = 120;
  std::size_t memory_bytes = 0;  ///< address space of each process; 0: no limit
  /// Limit of the size of each file, and of all files in the working folder together [bytes].
  std::size_t disk_bytes = std::size_t{1} << 30;
};

/// Returns the path of a program in the folders of PATH; empty if the program is not found.
[[nodiscard]] std::string find_program(const std::string& name);

/// Runs a program until it ends or exceeds a limit, and kills its remaining descendants. The
/// program has the working folder and TMPDIR `folder`, a separate session, and no standard input.
/// The outcome is `answered` for any exit status. This process must have no other children.
/// @param words  the program's path, then its arguments
[[nodiscard]] ProcessOutcome run_limited(const std::vector<std::string>& words,
                                         const std::filesystem::path& folder,
                                         const ProgramLimits& limits);

/// From now on, makes this process the parent of its orphaned descendants.
void adopt_descendants();
/// Kills every child of this process, including descendants that become its children.
void kill_descendants();

/// Returns the size of all files below a folder [bytes]. Counting stops above `stop_above`.
[[nodiscard]] std::size_t folder_size(const std::filesystem::path& folder, std::size_t stop_above);

/// From now on, SIGINT and SIGTERM end the program with exit status 128 + signal, after printing
/// `line` on standard error. However, `run_in_worker_processes` handles these signals itself, and
/// signals that are already ignored remain ignored.
void exit_on_signals(const std::string& line);

}  // namespace trammel::harness
