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

/// Runs cases: every (case, variant) is one independent computation.
namespace trammel::harness {

using results::Run;

/// Another solver in trammel's place.
struct OtherSolver {
  /// Computes a case or variant, in a process of its own.
  std::function<void(const Case& owner, const std::string& variant, const Document& document,
                     const std::vector<Check>& checks, bool with_sweeps, Run& run)>
      compute;                ///< empty: trammel computes
  std::string hash;           ///< of all that decides its answers, for the store
  unsigned time_limit_s = 0;  ///< of processor time
};

/// Discretization errors: of cases outside the catalogue, of all, or of none.
enum class ErrorWish { own_cases, all, none };

/// One of so many parts that a long call is computed in.
struct Shard {
  std::size_t number = 1, count = 1;
};

struct RunOptions {
  std::string variant;  ///< empty: all
  unsigned jobs = 1;
  TrackedQuantities tracked = TrackedQuantities::named;
  /// Called after each computation and every second with how many of how many are done.
  std::function<void(std::size_t done, std::size_t all)> progress;
  std::filesystem::path store = {};  ///< folder that computations are kept in; empty: none
  bool resume = false;               ///< takes over what the store has
  bool any_machine = false;          ///< also times of another machine
  std::size_t memory_bytes = 0;      ///< that one computation may use; 0: no limit
  OtherSolver solver = {};
  bool studies = true;  ///< refinements and validation uncertainty; off without a store alone
  ErrorWish errors = ErrorWish::own_cases;
  double warn_above = 0.01;                ///< relative error
  double accuracy = 0;                     ///< searched for; 0: what the case says
  std::vector<std::string> quantities = {};  ///< of the accuracy
};

/// Runs the cases, each run in a process of its own, and judges them. The numbers do not depend on
/// `jobs`. Bad input, a crash, more processor time than the case's timeout_s or too much memory
/// spoils its own run only: that run has the status "error". Those that SIGINT or SIGTERM has kept
/// from being done are "not-run".
[[nodiscard]] std::vector<Run> run_cases(const std::vector<Case>& cases,
                                         const References& references, const RunOptions& options);

/// As `run_cases`, with how far it is on standard error.
/// @param items  what is counted, in the plural
/// @throws Interrupted  where a signal came.
[[nodiscard]] std::vector<Run> run_shown(const std::vector<Case>& cases,
                                         const References& references, RunOptions options,
                                         const std::string& items = "runs");

/// What a shard of `run_cases` came to, computations that only other runs' checks look at included.
struct ShardRuns {
  std::vector<Run> runs;           ///< not judged; in the store
  std::vector<std::string> names;  ///< of the runs, each of one shard only
  std::size_t in_all = 0;          ///< computations of all shards
};
[[nodiscard]] ShardRuns run_shard(const std::vector<Case>& cases, const RunOptions& options,
                                  const Shard& shard);

/// What a variant comes to, in a process of its own, without sweeps and checks.
/// @throws InputError  where it has no solution, as `Interrupted` where a signal comes.
[[nodiscard]] Run solution_of(const Case& owner, const std::string& variant);

/// @throws InputError  where its input is to blame for an error, std::runtime_error where we are.
void require_no_error(const Run& run);
/// @throws InputError  also where there is no solution.
void require_solved(const Run& run);
/// Whether one of its checks does.
[[nodiscard]] bool fails_gate(const Run& run);

/// @throws Interrupted  where one of the runs was.
void require_complete(const std::vector<Run>& runs);

/// 0: every gate holds, 1: a check failed, or the bands do not hold, 2: bad input, 3: our own
/// fault.
[[nodiscard]] int exit_status(const std::vector<Run>& runs);

}  // namespace trammel::harness
