#pragma once

#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "harness/input/check.h"
#include "harness/judge/convergence.h"

/// Refinement sweeps: the same computation level by level.
namespace trammel::harness {

struct SweepLevel {
  double parameter = 0;
  AnalysisResult result;
};

struct Sweep {
  std::string name;
  std::vector<SweepLevel> levels;
};

/// Runs all sweeps of a case or variant. @throws InputError
[[nodiscard]] std::vector<Sweep> run_sweeps(const Document& document, const References& references);

/// Which quantities of a sweep are followed.
enum class TrackedQuantities {
  named,  ///< those that the sweep names, else those that the checks name
  all     ///< every one that changes with the level
};

[[nodiscard]] std::vector<Convergence> study_sweep(const Sweep& sweep, const Document& document,
                                                   const std::vector<Check>& checks,
                                                   const References& references,
                                                   TrackedQuantities tracked);

}  // namespace trammel::harness
