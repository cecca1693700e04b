#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

/// Somebody else's program, run once: whatever it does costs no more than its limits, and nothing
/// of it is left behind.
namespace trammel::harness {

struct ProgramLimits {
  double wall_s = 120;
  std::size_t memory_bytes = 0;  ///< address space of each of its processes; 0: no limit
  std::size_t disk_bytes = std::size_t{1} << 30;  ///< of each file, and of its folder as a whole
};

struct ProgramOutcome {
  enum class Ending { exited, signalled, timed_out, disk_full, not_started };
  Ending ending = Ending::not_started;
  int status = 0;      ///< exit status, number of the signal, or errno
  std::string output;  ///< the end of standard output and error, at most 64 KiB
  double wall_s = 0, cpu_s = 0;
};

/// Runs the program in the folder, which is also its TMPDIR, in a session of its own and without
/// standard input; then kills it with all that it has started. This process must have no other
/// children.
/// @param words  the program's path, then its arguments
[[nodiscard]] ProgramOutcome run_limited(const std::vector<std::string>& words,
                                         const std::filesystem::path& folder,
                                         const ProgramLimits& limits);

/// What descendants of this process leave behind becomes its own, from now on.
void adopt_descendants();
/// Kills every child of this process, and what becomes its child by that.
void end_descendants();

/// All files below a folder; more than `enough` is not looked at.
[[nodiscard]] std::size_t folder_bytes(const std::filesystem::path& folder, std::size_t enough);

}  // namespace trammel::harness
