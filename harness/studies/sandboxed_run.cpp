#include "harness/studies/sandboxed_run.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "harness/analysis/analysis.h"
#include "harness/base/json.h"
#include "harness/base/stopwatch.h"

namespace trammel::harness {
namespace {

/// Wall time beyond which a process that uses none of its processor time counts as hung.
constexpr unsigned kHangTimeoutFactor = 20;

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
  } catch (const std::bad_alloc&) {
    json["failure"] = "more memory than there is";
  } catch (const std::exception& error) {
    json["failure"] = error.what();
  }
  if (!json.contains("cpu_s")) json["cpu_s"] = watch.cpu_s();
  return json;
}

[[noreturn]] void compute(const Setting& setting, int time_limit_s, const References& references,
                          int out) {
  const auto seconds = static_cast<rlim_t>(time_limit_s);
  const rlimit limit{seconds, seconds + 1};
  setrlimit(RLIMIT_CPU, &limit);
  alarm(kHangTimeoutFactor * static_cast<unsigned>(time_limit_s));
  const std::string text = answer(setting, references).dump(-1, ' ', true);
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t n = write(out, text.data() + written, text.size() - written);
    if (n <= 0) break;
    written += static_cast<std::size_t>(n);
  }
  _exit(0);
}

std::string read_all(int in) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (ssize_t n = 0; (n = read(in, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

SandboxedRun read_answer(const std::string& text) {
  SandboxedRun sandboxed;
  const Json json = Json::parse(text, nullptr, false);
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
  for (const Json& list : json.at("values")) {
    sandboxed.values.emplace_back();
    for (const Json& value : list) {
      sandboxed.values.back().push_back(value.is_null() ? std::nan("") : value.get<double>());
    }
  }
  sandboxed.termination = SandboxedRun::Termination::solved;
  return sandboxed;
}

}  // namespace

SandboxedRun run_sandboxed(const Setting& setting, int time_limit_s, const References& references) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe for a trial");
  std::cout.flush();
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process for a trial");
  if (child == 0) {
    close(ends[0]);
    compute(setting, time_limit_s, references, ends[1]);
  }
  close(ends[1]);
  const std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!WIFSIGNALED(status)) return read_answer(text);
  SandboxedRun sandboxed;
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL) {
    sandboxed.termination = SandboxedRun::Termination::timed_out;
    sandboxed.cpu_s = time_limit_s;
    sandboxed.reason = "not done after " + std::to_string(time_limit_s) + " s of processor time";
  } else {
    sandboxed.reason = "the computation crashed (signal " + std::to_string(signal) + ")";
  }
  return sandboxed;
}

}  // namespace trammel::harness
