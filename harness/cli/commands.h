#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/cli/command_line.h"
#include "harness/input/reference_library.h"

/// The commands behind the words. Each returns the exit status, and throws InputError.
namespace trammel::harness {

struct RunCommand {
  std::vector<std::string> cases;   ///< names or files
  std::vector<std::string> labels;  ///< beside them
  std::string variant;
  unsigned jobs = 1;
  std::string out;
};

struct CostCommand {
  std::vector<std::string> what;    ///< families, studies, cases or files; empty: every study
  std::vector<std::string> sweeps;  ///< of the cases; empty: all
  std::string variant;              ///< of the cases
  bool quick = false;
  int repeats = 7;
  std::uint64_t seed = 1;
  std::string out;
};

struct EffectsCommand {
  std::string name, variant;        ///< of a case; or
  std::uint64_t seed = 1;           ///< of random scenes:
  std::uint64_t random = 0;         ///< so many of them,
  std::uint64_t scene = 0;          ///< or this one
  bool motion = false;              ///< of those in motion
  std::vector<std::string> labels;  ///< or every case of the catalogue with one of these
  double tolerance = 0.01;          ///< where the case does not give one
  int repeats = 7;                  ///< of each measurement of time
};

int list_cases(const std::vector<std::string>& labels, bool json);
int describe_case(const std::string& name, bool json);
int run_command(const RunCommand& command, const Renderers& renderers);
int compare_command(const std::string& a, const std::string& b);
int converge_command(const std::string& name, const std::string& variant, unsigned jobs);
int cost_command(const CostCommand& command, const Renderers& renderers);
int claims_command(unsigned jobs, bool json);
int effects_command(const EffectsCommand& command);
/// Hit rate of automatic effects: 1 below 99 % within tolerance or 90 % minimal.
int random_effects_command(const EffectsCommand& command);
/// A table of what the labelled cases call for: 1 where one is beyond its tolerance.
int labelled_effects_command(const EffectsCommand& command);
/// The page of the whole catalogue with its cost studies and claims, or of the cases named.
int report_command(const RunCommand& command, const Renderers& renderers);

/// The quick sweep of every study of the catalogue, as results.json has it.
/// @param error_messages  gets a line for each study that could not be measured
[[nodiscard]] Json quick_cost(const References& references,
                              std::vector<std::string>& error_messages);

}  // namespace trammel::harness
