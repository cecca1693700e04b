#include "harness/studies/sandboxed_run.h"

#include <array>
#include <exception>

#include "harness/analysis/analysis.h"
#include "harness/base/errors.h"
#include "harness/base/json.h"
#include "harness/base/processes.h"
#include "harness/base/stopwatch.h"

namespace trammel::harness {
namespace {

Json answer(const Setting& setting, const References& references) {
  Json json = Json::object();
  const Stopwatch watch;
  try {
    const AnalysisResult result = analyse(setting.document, references, {false});
    json["cpu_s"] = watch.cpu_s();
    json["counters"] = {result.counters.element_evaluations, result.counters.factorizations,
                        result.counters.solves, result.counters.steps};
    if (!result.outcome.solved()) {
      json["failure"] = result.outcome.reason.empty() ? "no solution" : result.outcome.reason;
      return json;
    }
    json["values"] = observe(result.quantities, setting.observed);
    json["quantities"] = Json::object();
    for (const auto& [name, quantity] : result.quantities)
      if (setting.observed.empty()) json["quantities"][name] = quantity.values;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    json["failure"] = error.what();
  }
  if (!json.contains("cpu_s")) json["cpu_s"] = watch.cpu_s();
  return json;
}

SandboxedRun read_answer(const std::string& text) {
  SandboxedRun sandboxed;
  const Json json = Json::from_cbor(text, true, false);
  if (json.is_discarded()) {
    sandboxed.reason = "the computation ended without an answer";
    return sandboxed;
  }
  sandboxed.cpu_s = json.at("cpu_s").get<double>();
  if (json.contains("counters")) {
    const auto counts = json.at("counters").get<std::array<std::int64_t, 4>>();
    sandboxed.counters = {counts[0], counts[1], counts[2], counts[3]};
  }
  if (json.contains("failure")) {
    sandboxed.reason = json.at("failure").get<std::string>();
    return sandboxed;
  }
  sandboxed.values = json.at("values").get<Observations>();
  sandboxed.quantities = json.at("quantities").get<decltype(sandboxed.quantities)>();
  sandboxed.termination = SandboxedRun::Termination::solved;
  return sandboxed;
}

}  // namespace

SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s, const References& references,
                           const std::function<void()>& waiting) {
  const auto work = [&] {
    const std::vector<std::uint8_t> bytes = Json::to_cbor(answer(setting, references));
    return std::string(bytes.begin(), bytes.end());
  };
  const ProcessOutcome outcome =
      run_limited({work, static_cast<unsigned>(time_limit_s)}, {1, memory_limit_bytes(), waiting});
  if (outcome.termination == ProcessOutcome::Termination::answered)
    return read_answer(outcome.text);
  SandboxedRun sandboxed;
  sandboxed.reason = outcome.text;
  if (outcome.termination == ProcessOutcome::Termination::timed_out) {
    sandboxed.termination = SandboxedRun::Termination::timed_out;
    sandboxed.cpu_s = time_limit_s;
  }
  return sandboxed;
}

}  // namespace trammel::harness
