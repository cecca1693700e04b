#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/input/case.h"
#include "harness/judge/evaluate_check.h"
#include "harness/judge/sweep.h"
#include "harness/judge/uncertainty_summary.h"
#include "harness/studies/validation_uncertainty.h"

/// Runs cases: every (case, variant) is one independent computation.
namespace trammel::harness {

struct RunOptions {
  std::string variant;  ///< empty: all
  unsigned jobs = 1;
  TrackedQuantities tracked = TrackedQuantities::named;
  /// Called after each computation with how many of how many are done; from any thread, one at a
  /// time.
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// What came of one variant of a case.
struct Run {
  std::string case_id, variant;
  std::string status;  ///< solved, singular, not-converged, error or not-run
  std::string reason;
  enum class RunError { none, input, internal };
  RunError error = RunError::none;  ///< of a run with status "error"
  AnalysisResult result;
  std::vector<Sweep> sweeps;
  std::vector<CheckResult> check_results;
  std::vector<Convergence> convergence;
  ValidationUncertainty uncertainty;  ///< empty where the case does not ask for it
  double wall_s = 0, cpu_s = 0;       ///< of the computation and its sweeps
  double uncertainty_wall_s = 0;      ///< of `uncertainty`
};

/// Runs the cases, and judges them. The numbers do not depend on `jobs`.
/// Bad input spoils its own run only: that run has the status "error".
[[nodiscard]] std::vector<Run> run_cases(const std::vector<Case>& cases,
                                         const References& references, const RunOptions& options);

/// The bands of all refinements of the runs against the exact values, where there are any.
[[nodiscard]] NumericalUncertaintySummary numerical_uncertainty_of(const std::vector<Run>& runs);

/// 0: every gate holds, 1: a check failed, or the bands do not hold, 2: bad input, 3: our own
/// fault.
[[nodiscard]] int exit_status(const std::vector<Run>& runs);

}  // namespace trammel::harness
