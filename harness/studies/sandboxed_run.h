#pragma once

#include <functional>

#include "harness/results/cost_results.h"
#include "harness/studies/cost_study.h"

namespace trammel::harness {

using results::SandboxedRun;

/// Computes a setting once, in a process of its own that is ended when it has used up its processor
/// time: an endless loop or a crash costs no more than that.
/// @param waiting  called about once a second until then
[[nodiscard]] SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s,
                                         const References& references,
                                         const std::function<void()>& waiting = {});

}  // namespace trammel::harness
