#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace trammel::harness {

struct Renderers;

struct CompareCommand {
  std::vector<std::string> sides;  ///< variants or cases; or results files and folders
  bool csv = false, json = false, gate = false;
  std::filesystem::path html;  ///< empty: no page
};

/// Any number of sides against the first. @returns the exit status: with `gate` 1 where something
/// changed beyond round-off
int compare_command(const CompareCommand& command, const Renderers& renderers);

}  // namespace trammel::harness
