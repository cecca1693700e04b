#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/cli/command_line.h"
#include "harness/results/results.h"

namespace trammel::harness {

struct EffectsCommand {
  std::string name, variant;        ///< of a case; or
  std::uint64_t seed = 1;           ///< of random scenes:
  std::uint64_t random = 0;         ///< so many of them,
  std::uint64_t scene = 0;          ///< or this one
  std::vector<std::string> labels;  ///< or every case of the catalogue with one of these
  double tolerance = 0.01;          ///< where the case does not give one
  int repeats = 7;                  ///< of each measurement of time
  bool json = false;                ///< instead of tables
  std::string out;                  ///< folder of a page of many scenes; empty: none
};

/// To find what choosing effects comes to in each scene of the catalogue, into the store.
[[nodiscard]] std::vector<std::function<void()>> effect_scene_work(
    const std::filesystem::path& store, bool resume);

/// What choosing effects comes to in every scene of the catalogue.
/// @param resume  takes what the store has
[[nodiscard]] std::vector<results::EffectScene> catalogue_effect_scenes(
    const std::filesystem::path& store, bool resume);

/// What each effect is worth in one scene. @returns the exit status
int effects_command(const EffectsCommand& command);
/// Hit rate of automatic effects: 1 below 99 % within tolerance or 90 % minimal.
int random_effects_command(const EffectsCommand& command, const Renderers& renderers);
/// A table of what the labelled cases call for: 1 where one is beyond its tolerance.
int labelled_effects_command(const EffectsCommand& command, const Renderers& renderers);

}  // namespace trammel::harness
