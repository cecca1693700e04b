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

/// What the harness cannot know: how results become a page and a JUnit file.
struct Renderers {
  std::function<std::filesystem::path(const results::Results& results,
                                      const std::filesystem::path& folder)>
      report;
  std::function<void(const results::Results& results, const std::filesystem::path& junit)> junit;
  std::function<bool()> can_draw;  ///< whether there is what a report is drawn with
  /// The results of several codes side by side.
  std::function<std::filesystem::path(const std::vector<std::filesystem::path>& results,
                                      const std::filesystem::path& folder)>
      codes;
  /// Sides beside each other, with their curves, in one file.
  std::function<void(const results::SideComparison& comparison, const std::filesystem::path& file)>
      comparison;
};

/// What a command says that a signal ends and that has a store.
inline constexpr const char* kInterrupted =
    "trammel: interrupted; with --resume the same command does what is missing\n";

/// @throws InputError  where a report could not be drawn: before any work is done.
void require_drawing(const Renderers& renderers);

/// Runs the program. @returns 0: every gate holds, 1: a check failed, 2: bad usage or input, 3: our
/// own fault.
/// @throws std::bad_alloc  where memory runs out.
/// @param arguments  the command line without the program's name
[[nodiscard]] int run_command_line(const std::vector<std::string>& arguments,
                                   const Renderers& renderers);

}  // namespace trammel::harness
