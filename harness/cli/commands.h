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

/// Commands of the program. Each command reads its options, prints its results and returns the exit
/// status.
namespace trammel::harness {

/// Options of a command line. A command ignores options that it does not declare.
struct CommandOptions {
  std::vector<std::string> words;       ///< positional arguments: cases, files, folders, names
  std::string word;                     ///< single positional argument of commands that have one
  std::vector<std::string> labels;      ///< labels that each case must have
  std::vector<std::string> any_labels;  ///< labels of which a case must have at least one
  std::string variant;
  unsigned jobs = std::max(1U, std::thread::hardware_concurrency());
  std::string out;    ///< output folder (`export`, `solve`: file); empty: standard output
  std::string store;  ///< folder of stored computations; empty: OUT/store
  bool resume = false, fresh = false;
  bool any_machine = false;  ///< with --resume, reuse times measured on other machines
  std::size_t memory_bytes = memory_limit_bytes();  ///< memory limit of one run; 0: none
  bool json = false, csv = false;
  bool quiet = false;  ///< prints only runs that fail or have warnings, and the summary

  std::string shard;    ///< "K/N" for `run`: the K-th of N shards
  std::string history;  ///< SQLite file for verdicts and times; empty: none
  bool vtk = false;
  bool pdf = false, open = false;  ///< for `report`

  std::string html;  ///< for `compare`: file of the page; empty: none
  bool gate = false;

  std::vector<std::string> sweeps;  ///< names of sweeps for `cost` and `export`; empty: all
  bool quick = false;
  int repeats = 7;
  std::size_t seed = 1;
  /// `all_errors`: estimate the discretization errors of all cases. `no_errors`: estimate none.
  bool all_errors = false, no_errors = false;
  double warn_above = 0;  ///< relative discretization error for warnings; 0: default
  double accuracy = 0;    ///< relative error for the search of mesh and step; 0: no search
  std::vector<std::string> quantities;  ///< quantities that the search must make accurate
  double time_limit_s = 120;            ///< time limit of the search [s]

  double tolerance = 0.01;  ///< permitted relative change of the results, for `effects`

  std::vector<std::string> builds;  ///< results.json of other builds, for `certify`

  int level = -1;  ///< level of the sweep written by `export`; -1: the case itself
  std::string matrices;

  std::string adapter;      ///< for `grade`: the program with its arguments
  double max_time_s = 120;  ///< wall time limit of one call of the adapter
  std::size_t max_disk_bytes = std::size_t{1} << 30;  ///< limit of the adapter's files [bytes]
  std::size_t shard_count = 0;                        ///< number of shards, for `slurm`
  /// Time limit of a job in the format of sbatch; empty: default of the partition.
  std::string job_time;
};

using Command = int(const CommandOptions& options, const Renderers& renderers);

Command list_command, describe_command, quantities_command, references_command;
Command run_command, converge_command, report_command, merge_command, slurm_command;
Command compare_command, certify_command, history_command;
Command cost_command, effects_command;
Command claims_command, paper_command, coverage_command;
Command export_command, solve_command, grade_command;

/// Returns the cases with the given names or labels; all cases of the catalogue if the options
/// contain neither names nor labels.
/// @throws InputError  if a case cannot be read.
[[nodiscard]] std::vector<Case> select_cases(const CommandOptions& options);

/// Splits "CASE:VARIANT" into case and variant; the variant is empty if there is none. A colon in
/// the name of a folder or of an existing file does not separate a variant.
[[nodiscard]] std::pair<std::string, std::string> split_case_name(const std::string& name);

/// Returns the case that "CASE:VARIANT" or "CASE" names, and the variant or "".
/// @param option  value of the option --variant; empty if absent
/// @throws InputError  if the case cannot be read, or if `name` and `option` both name a variant
[[nodiscard]] std::pair<Case, std::string> load_case_variant(const std::string& name,
                                                             const std::string& option = "");

/// Returns the results file for a path: the path itself, or results.json if the path is a folder.
[[nodiscard]] std::filesystem::path results_file_path(const std::string& name);
/// Returns the JSON of a results file, or null if the file contains no results.
/// @throws InputError  if a file named *.json cannot be read
[[nodiscard]] Json read_json_if_results(const std::filesystem::path& file);

/// Returns the folder of stored computations: `store` if it is not empty, else OUT/store.
/// @throws InputError  if OUT/store is a symbolic link, which could lead out of OUT.
[[nodiscard]] std::filesystem::path store_folder(const std::string& out, const std::string& store);

/// Writes results.json, junit.xml (if there are runs) and the pages, completely or not at all.
/// @returns the path of the first page
[[nodiscard]] std::filesystem::path write_pages(const results::Results& results,
                                                const std::string& out, const Renderers& renderers);

/// Returns functions that measure each cost study of the catalogue with its short selection of
/// settings (SweepExtent::quick) and store the results.
/// @throws InputError  from the functions, with the message that `quick_cost_studies` reports for
/// the study
[[nodiscard]] std::vector<std::function<void()>> quick_cost_work(const References& references,
                                                                 const std::filesystem::path& store,
                                                                 bool resume);

/// Returns functions that measure the automatic selection of effects in each case of the catalogue
/// with the label "effects", and store the results.
[[nodiscard]] std::vector<std::function<void()>> effect_scene_work(
    const std::filesystem::path& store, bool resume);

/// Returns the measured selections of effects for all cases of the catalogue with the label
/// "effects", in the form of results.json.
[[nodiscard]] std::vector<results::EffectScene> catalogue_effect_scenes(
    const std::filesystem::path& store, bool resume);

/// Returns all cost studies of the catalogue, measured with their short selection of settings
/// (SweepExtent::quick), in the form of results.json.
/// @param error_messages  receives a line for each study that could not be measured
[[nodiscard]] results::CostStudies quick_cost_studies(const References& references,
                                                      const std::filesystem::path& store,
                                                      bool resume,
                                                      std::vector<std::string>& error_messages);

}  // namespace trammel::harness
