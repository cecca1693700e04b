#include <exception>

#include "harness/analysis/analysis.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/stopwatch.h"
#include "harness/results/result_fields.h"
#include "harness/studies/cost_study.h"

namespace trammel::harness {
namespace {

SandboxedRun compute(const Setting& setting, const References& references) {
  SandboxedRun run;
  run.counters = named_counters({});
  const Stopwatch watch;
  try {
    const AnalysisResult result = analyze(setting.document, references, {false});
    run.cpu_s = watch.cpu_s();
    run.counters = named_counters(result.counters);
    if (!result.outcome.solved()) {
      run.reason = result.outcome.reason.empty() ? "no solution" : result.outcome.reason;
      return run;
    }
    run.values = extract_observations(result.quantities, setting.observed);
    for (const auto& [name, quantity] : result.quantities)
      if (setting.observed.empty()) run.quantities[name] = quantity.values;
    run.termination = SandboxedRun::Termination::solved;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    run.reason = error.what();
  }
  if (run.cpu_s == 0) run.cpu_s = watch.cpu_s();
  return run;
}

}  // namespace

SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s, const References& references,
                           const std::function<void()>& waiting) {
  const auto work = [&] {
    std::string bytes;
    Json::to_cbor(results::to_json(compute(setting, references), results::Form::store), bytes);
    return bytes;
  };
  const ProcessOutcome outcome =
      run_limited({work, static_cast<unsigned>(time_limit_s)}, {1, memory_limit_bytes(), waiting});
  SandboxedRun sandboxed;
  sandboxed.counters = named_counters({});
  sandboxed.reason = outcome.text;
  if (outcome.termination == ProcessOutcome::Termination::answered) {
    try {
      return results::from_json<SandboxedRun>(parse_cbor(outcome.text));
    } catch (const std::exception&) {
      sandboxed.reason = "the computation ended without an answer";
    }
  }
  if (outcome.termination == ProcessOutcome::Termination::timed_out) {
    sandboxed.termination = SandboxedRun::Termination::timed_out;
    sandboxed.cpu_s = time_limit_s;
  }
  return sandboxed;
}

}  // namespace trammel::harness
