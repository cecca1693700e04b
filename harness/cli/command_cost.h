#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/cli/command_line.h"
#include "harness/input/reference_library.h"
#include "harness/results/cost_results.h"

namespace trammel::harness {

struct CostCommand {
  std::vector<std::string> what;    ///< families, studies, cases or files; empty: every study
  std::vector<std::string> sweeps;  ///< of the cases; empty: all
  std::string variant;              ///< of the cases
  bool quick = false;
  int repeats = 7;
  std::uint64_t seed = 1;
  std::string out = "trammel-cost";
  double accuracy = 0;  ///< the settings are searched for this error; 0: they are not
  std::vector<std::string> quantities;  ///< that the search looks at
  double time_limit_s = 120;            ///< of the search
  std::string store;                    ///< folder; empty: in `out`
  bool resume = false;
  bool json = false;  ///< results.json instead of tables; of a search what it chose
};

/// The folder that computations are kept in.
/// @throws InputError  where a link would lead out of `out`.
[[nodiscard]] std::filesystem::path store_folder(const std::string& out, const std::string& store);

/// What accuracy costs in time. @returns the exit status
int cost_command(const CostCommand& command, const Renderers& renderers);

/// To measure the quick sweep of each study of the catalogue into the store.
/// @throws InputError  from the work: what `quick_cost` says of that study
[[nodiscard]] std::vector<std::function<void()>> quick_cost_work(const References& references,
                                                                 const std::filesystem::path& store,
                                                                 bool resume);

/// The quick sweep of every study of the catalogue, as results.json has it.
/// @param store, resume   as `measure_or_find`
/// @param error_messages  gets a line for each study that could not be measured
[[nodiscard]] results::CostStudies quick_cost(const References& references,
                                              const std::filesystem::path& store, bool resume,
                                              std::vector<std::string>& error_messages);

}  // namespace trammel::harness
