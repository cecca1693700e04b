#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/cli/command_line.h"
#include "harness/results/results.h"

namespace trammel::harness {

struct EffectsCommand {
  std::vector<std::string> names;   ///< names or files of cases; or
  std::vector<std::string> labels;  ///< every case of the catalogue with one of these
  std::string variant;
  double tolerance = 0.01;  ///< where the case does not give one
  int repeats = 7;          ///< of each measurement of time
  bool json = false;        ///< instead of tables
  std::string out;          ///< folder of a page of many scenes; empty: none
};

/// To find what choosing effects comes to in each scene of the catalogue, into the store.
[[nodiscard]] std::vector<std::function<void()>> effect_scene_work(
    const std::filesystem::path& store, bool resume);

/// What choosing effects comes to in every scene of the catalogue.
/// @param resume  takes what the store has
[[nodiscard]] std::vector<results::EffectScene> catalogue_effect_scenes(
    const std::filesystem::path& store, bool resume);

/// Prints the contribution of each effect in one case. @returns the exit status
int effects_command(const EffectsCommand& command);
/// Prints a table of the effects that several cases require. @returns 1 where one is beyond its
/// tolerance
int effects_table_command(const EffectsCommand& command, const Renderers& renderers);

}  // namespace trammel::harness
