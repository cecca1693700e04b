#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "harness/base/processes.h"
#include "harness/cli/command_line.h"
#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/results/cost_results.h"
#include "harness/results/results.h"

/// The commands of the program: each reads its options, prints and returns the exit status.
namespace trammel::harness {

/// The words of a command line. A command ignores what it has no option for.
struct CommandOptions {
  std::vector<std::string> words;  ///< arguments without a dash: cases, files, folders, names
  std::string word;                ///< the same of a command that has one
  std::vector<std::string> labels;
  std::string variant;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::string out;    ///< folder; of `export` and `solve` a file; empty: standard output
  std::string store;  ///< folder; empty: in `out`
  bool resume = false, fresh = false;
  bool any_machine = false;                         ///< resumes also with times of another machine
  std::size_t memory_bytes = memory_limit_bytes();  ///< of one run; 0: no limit
  bool json = false, csv = false;

  std::string shard;    ///< of `run`: "K/N"
  std::string costs;    ///< results.json that shards are balanced by
  std::string history;  ///< SQLite file that the call is added to; empty: none
  bool measurements = false;
  bool vtk = false;

  std::string html;  ///< of `compare`: file of the page; empty: none
  bool gate = false;

  std::vector<std::string> sweeps;  ///< of the cases of `cost` and `export`; empty: all
  bool quick = false;
  int repeats = 7;
  std::size_t seed = 1;
  bool all_errors = false, no_errors = false;  ///< estimates of discretization errors
  double warn_above = 0.01;                    ///< relative error
  double accuracy = 0;  ///< mesh and step are searched for this relative error; 0: they are not
  std::vector<std::string> quantities;  ///< that the search considers
  double time_limit_s = 120;            ///< of the search

  double tolerance = 0.01;  ///< of `effects`, relative

  std::vector<std::string> builds;  ///< of `certify`: results.json of the same cases
  bool gaps = false;                ///< of `coverage`: only rows without independent evidence

  int level = -1;  ///< of the sweep that `export` writes; -1: the case itself
  std::string matrices;

  std::string adapter;                                ///< of `grade`: the program, with arguments
  double max_time_s = 120;                            ///< wall time of one call of the adapter
  std::size_t max_disk_bytes = std::size_t{1} << 30;  ///< of its files
  std::size_t shard_count = 0;                        ///< of `slurm`
  std::string job_time;  ///< as sbatch reads it; empty: the partition's default
};

using Command = int(const CommandOptions& options, const Renderers& renderers);

Command list_command, describe_command, quantities_command, references_command;
Command run_command, converge_command, report_command, merge_command, slurm_command;
Command compare_command, certify_command, history_command;
Command cost_command, effects_command;
Command claims_command, paper_command, coverage_command;
Command export_command, solve_command, grade_command;

/// The cases that are named, and those with the labels; the full catalogue if there are neither.
/// @throws InputError  if one of them cannot be read.
[[nodiscard]] std::vector<Case> select_cases(const CommandOptions& options);

/// The results file that a name means: the file itself, or results.json in the folder.
[[nodiscard]] std::filesystem::path results_path(const std::string& name);
/// The JSON of a results file; null of a file that holds no results.
/// @throws InputError  if a file named *.json cannot be read
[[nodiscard]] Json read_if_results(const std::filesystem::path& file);

/// The folder that computations are kept in.
/// @throws InputError  if a link would lead out of `out`.
[[nodiscard]] std::filesystem::path store_folder(const std::string& out, const std::string& store);

/// Writes results.json, junit.xml if there are runs, and the pages, all of them or nothing.
/// @returns the first page
[[nodiscard]] std::filesystem::path write_pages(const results::Results& results,
                                                const std::string& out, const Renderers& renderers);

/// Measures the quick sweep of each study of the catalogue into the store.
/// @throws InputError  from the work: the message that `quick_cost` reports for the study
[[nodiscard]] std::vector<std::function<void()>> quick_cost_work(const References& references,
                                                                 const std::filesystem::path& store,
                                                                 bool resume);

/// Measures the selection of effects in each scene of the catalogue into the store.
[[nodiscard]] std::vector<std::function<void()>> effect_scene_work(
    const std::filesystem::path& store, bool resume);

/// The same as in results.json.
[[nodiscard]] std::vector<results::EffectScene> catalogue_effect_scenes(
    const std::filesystem::path& store, bool resume);

/// The quick sweep of every study of the catalogue, as in results.json.
/// @param error_messages  gets a line for each study that could not be measured
[[nodiscard]] results::CostStudies quick_cost(const References& references,
                                              const std::filesystem::path& store, bool resume,
                                              std::vector<std::string>& error_messages);

}  // namespace trammel::harness
