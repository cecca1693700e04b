#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/input/case.h"
#include "harness/judge/convergence.h"
#include "harness/judge/evaluate_check.h"
#include "harness/judge/sweep.h"
#include "harness/results/results.h"

/// Execution of cases. Every variant of a case is one independent computation (run).
namespace trammel::harness {

using results::Run;

/// Another solver that computes the cases in place of trammel.
struct OtherSolver {
  /// Computes a case or variant with the solver in a separate process.
  std::function<void(const Case& owner, const std::string& variant, const Document& document,
                     const std::vector<Check>& checks, bool with_sweeps, Run& run)>
      compute;                ///< empty: trammel computes the cases
  std::string hash;           ///< key of the solver's answers in the run store
  unsigned time_limit_s = 0;  ///< limit of the processor time of one computation
};

/// Cases whose discretization errors are estimated: cases outside of the catalogue, all, or none.
enum class ErrorWish { own_cases, all, none };

/// Shard `number` of `count`: one of `count` separately computed parts of a long call.
struct Shard {
  std::size_t number = 1, count = 1;
};

struct RunOptions {
  std::string variant = {};  ///< variant to run; empty: all variants
  unsigned jobs = 1;
  TrackedQuantities tracked = TrackedQuantities::named;
  /// Called after each computation and every second, with the number of finished and of all
  /// computations.
  std::function<void(std::size_t done, std::size_t all)> progress = {};
  std::filesystem::path store = {};  ///< folder of the run store; empty: no store
  bool resume = false;               ///< reuse stored computations
  bool any_machine = false;          ///< also reuse times measured by another machine
  std::size_t memory_bytes = 0;      ///< memory limit of one computation; 0: none
  OtherSolver solver = {};
  /// True if refinement sweeps and validation uncertainties are computed. May be false only if
  /// there is no run store.
  bool studies = true;
  ErrorWish errors = ErrorWish::own_cases;
  /// Relative discretization error of a quantity above which a warning is added to the run.
  double warn_above = 0.01;
  double accuracy = 0;                       ///< requested accuracy; 0: mesh of the case
  std::vector<std::string> quantities = {};  ///< quantities that require this accuracy
};

/// Runs the cases, each run in a separate process, and judges the runs. The results do not depend
/// on `jobs`. A run has the status "error" after bad input, a crash, excessive memory use, or more
/// processor time than the case's timeout_s. Other runs are not affected. Runs prevented by SIGINT
/// or SIGTERM have the status "not-run".
[[nodiscard]] std::vector<Run> run_cases(const std::vector<Case>& cases,
                                         const References& references, const RunOptions& options);

/// Runs the cases as `run_cases` does and shows the progress on standard error.
/// @param items  plural noun for the progress, such as "runs".
/// @throws Interrupted  if a signal was received.
[[nodiscard]] std::vector<Run> run_with_progress(const std::vector<Case>& cases,
                                                 const References& references, RunOptions options,
                                                 const std::string& items = "runs");

/// Computations of one shard. They include runs that only the checks of other runs require.
struct ShardRuns {
  std::vector<Run> runs;           ///< runs without verdicts; also in the store
  std::vector<std::string> names;  ///< names of the runs; each run belongs to a single shard
  std::size_t in_all = 0;          ///< number of computations in all shards
};
[[nodiscard]] ShardRuns run_shard(const std::vector<Case>& cases, const RunOptions& options,
                                  const Shard& shard);

/// Computes a variant in a separate process, without sweeps and checks.
/// @throws InputError  if the variant has no solution, and Interrupted if SIGINT or SIGTERM was
/// received.
[[nodiscard]] Run run_variant(const Case& owner, const std::string& variant);

/// @throws InputError  if the run failed because of its input, and std::runtime_error if the run
///     failed by an internal error.
void require_no_error(const Run& run);
/// @throws InputError  if the run failed because of its input, or has no solution.
void require_solved(const Run& run);
/// Returns true if a check of the run has a verdict that counts as a failure.
[[nodiscard]] bool counts_as_failure(const Run& run);

/// @throws Interrupted  if a signal interrupted one of the runs.
void require_uninterrupted(const std::vector<Run>& runs);

/// Returns the exit status: 0 if all checks hold, 1 if a check or the summary of numerical
/// uncertainty fails, 2 for bad input, 3 for an internal error.
[[nodiscard]] int exit_status(const std::vector<Run>& runs);

}  // namespace trammel::harness
