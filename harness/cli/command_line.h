#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace trammel::results {
struct Results;
struct SideComparison;
}  // namespace trammel::results

namespace trammel::harness {

/// Functions of the report module, which render results as a page or a JUnit file.
struct Renderers {
  std::function<std::filesystem::path(const results::Results& results,
                                      const std::filesystem::path& folder)>
      report;
  std::function<void(const results::Results& results, const std::filesystem::path& junit)> junit;
  std::function<bool()>
      has_gnuplot;  ///< returns true if the tools for drawing a report are available
  /// Writes a page that compares the results of several codes.
  std::function<std::filesystem::path(const std::vector<std::filesystem::path>& results,
                                      const std::filesystem::path& folder)>
      codes;
  /// Writes a comparison of results, with overlaid curves, as a page into one file.
  std::function<void(const results::SideComparison& comparison, const std::filesystem::path& file)>
      comparison;
};

/// Message printed if SIGINT or SIGTERM interrupts a command that stores its finished computations.
inline constexpr const char* kInterrupted =
    "trammel: interrupted; with --resume the same command computes the rest\n";

/// Requires the tools for drawing reports, before computations start.
/// @throws InputError  if a report cannot be drawn.
void require_gnuplot(const Renderers& renderers);

/// Runs the program.
/// @param arguments  the command line without the program's name.
/// @returns 0 if every check passes, 1 if a check failed, 2 for bad usage or input, 3 for an
/// internal error.
/// @throws std::bad_alloc  if memory is exhausted.
[[nodiscard]] int run_command_line(const std::vector<std::string>& arguments,
                                   const Renderers& renderers);

}  // namespace trammel::harness
