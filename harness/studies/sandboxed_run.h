#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "harness/studies/cost_study.h"
#include "solver/linear/system.h"

namespace trammel::harness {

/// What one computation of a setting came to.
struct SandboxedRun {
  enum class Termination { solved, failed, timed_out };
  Termination termination = Termination::failed;
  std::string reason;  ///< of a failure
  Observations values;
  std::map<std::string, std::vector<double>> quantities;  ///< all, where none is observed
  solver::Counters counters;
  double cpu_s = 0;
};

/// Computes a setting once, in a process of its own that is ended when it has used up its processor
/// time: an endless loop or a crash costs no more than that.
/// @param waiting  called about once a second until then
[[nodiscard]] SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s,
                                         const References& references,
                                         const std::function<void()>& waiting = {});

}  // namespace trammel::harness
