#include "harness/grade/grade.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>

#include "harness/base/environment.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/text.h"
#include "harness/export/exported_case.h"
#include "harness/input/document.h"
#include "harness/results/quantity_definitions.h"
#include "harness/results/result_fields.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;
using results::Status;
using Ending = ProcessOutcome::Termination;

constexpr int kCannot = 4;  // exit status of an adapter whose code does not support the case
constexpr std::size_t kMaxKeptBytes = std::size_t{16} << 20;  // maximum size of files kept per call

/// Returns ": " and the last non-blank line of a program's output; empty if the output is blank.
std::string last_line(const std::string& output) {
  std::string line, last;
  for (std::istringstream lines(output); std::getline(lines, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  return last.empty() ? "" : ": " + printable(last, 200);
}

void end_as(Run& run, results::Status status, const std::string& reason) {
  run.status = status;
  run.reason = reason;
}

/// Sets the status of a run whose adapter failed or exceeded a limit. Returns false if the adapter
/// ended normally, so that its RESULT.json must be read.
bool record_missing_answer(const ProcessOutcome& outcome, const ProgramLimits& limits, Run& run) {
  switch (outcome.termination) {
    case Ending::timed_out:
      end_as(run, Status::timed_out, "stopped after " + shortest_decimal(limits.wall_s) + " s");
      return true;
    case Ending::disk_full:
      end_as(run, Status::crashed,
             "more than " + std::to_string(limits.disk_bytes >> 20) + " MiB of files written");
      return true;
    case Ending::not_started:
      end_as(run, Status::error, std::string("not started: ") + std::strerror(outcome.status));
      return true;
    case Ending::out_of_memory:
    case Ending::crashed:
      end_as(run, Status::crashed,
             "signal " + std::to_string(outcome.status) + ", " + strsignal(outcome.status) +
                 last_line(outcome.text));
      return true;
    case Ending::answered:
      break;
  }
  if (outcome.status == 0 || outcome.status == kCannot) return false;
  end_as(run, Status::crashed,
         "exit status " + std::to_string(outcome.status) + last_line(outcome.text));
  return true;
}

/// Removes the file from a message: "FILE: /model/trajectory: ..." becomes "/model/trajectory:
/// ...".
std::string remove_file_name(const std::string& message) {
  const std::size_t at = message.find(": /");
  return at == std::string::npos ? message : message.substr(at + 2);
}

/// Runs the adapter once in a separate folder. The files in this folder are kept unless their total
/// size exceeds `kMaxKeptBytes`.
void call(const Adapter& adapter, const fs::path& folder, const Json& json, Run& run) {
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directories(folder);
  write_file(folder / "case.json", format_json(json));
  std::vector<std::string> words = adapter.words;
  words.push_back((folder / "case.json").string());
  words.push_back((folder / "result.json").string());
  const ProcessOutcome outcome = run_limited(words, folder, adapter.limits);
  run.cost.wall_s += outcome.wall_s;
  run.cost.cpu_s += outcome.cpu_s;
  try {
    if (!record_missing_answer(outcome, adapter.limits, run)) {
      const bool cannot = outcome.status == kCannot;
      const std::string said = last_line(outcome.text);
      if (cannot)
        end_as(run, Status::cannot, "exit status 4" + (said.empty() ? " without a reason" : said));
      if (!cannot || fs::exists(folder / "result.json", error))
        read_adapter_answer(folder / "result.json", json.at("export"), run);
      if (cannot) run.status = Status::cannot;
    }
  } catch (const InputError& broken) {
    end_as(run, Status::error, one_line(broken.what()));
  }
  if (folder_size(folder, kMaxKeptBytes) > kMaxKeptBytes) {
    fs::remove_all(folder, error);
    fs::create_directories(folder, error);
  }
  if (fs::is_directory(folder, error)) write_file(folder / "output.txt", outcome.text);
}

/// Computes all levels of the refinement sweeps whose order of convergence is checked. A level
/// without a solution has no quantities.
std::vector<results::Sweep> swept(const Adapter& adapter, const fs::path& folder, const Case& owner,
                                  const std::string& variant, const Document& document,
                                  const std::vector<Check>& checks, Run& run) {
  std::set<std::string> names;
  for (const Check& check : checks)
    if (check.order) names.insert(check.order->sweep);
  std::vector<results::Sweep> sweeps;
  for (const std::string& name : names) {
    results::Sweep sweep{name, {}};
    for (const Level& level : sweep_levels(document, name)) {
      Run found;
      const std::size_t number = sweep.levels.size();
      call(adapter, folder / (name + "-" + std::to_string(number)),
           export_case(owner, {variant, name, number}), found);
      run.cost.wall_s += found.cost.wall_s;
      run.cost.cpu_s += found.cost.cpu_s;
      if (!found.is_solved()) found.quantities.clear();
      sweep.levels.push_back({level.parameter, std::move(found.quantities)});
    }
    sweeps.push_back(std::move(sweep));
  }
  return sweeps;
}

}  // namespace

std::vector<std::string> split_adapter_command(const std::string& command) {
  std::vector<std::string> words;
  if (fs::is_regular_file(command)) {
    words = {command};
  } else {
    std::istringstream text(command);
    for (std::string word; text >> word;) words.push_back(word);
  }
  if (words.empty()) throw InputError("ADAPTER: the command is empty; expected a program");
  if (words.front().find('/') == std::string::npos && !fs::is_regular_file(words.front()))
    if (const std::string path = find_program(words.front()); !path.empty()) words.front() = path;
  for (std::string& word : words) {
    if (fs::is_regular_file(word)) {
      word = fs::absolute(word).lexically_normal().string();
    } else if (fs::path(word).extension() == ".py") {
      throw InputError("ADAPTER: expected an existing file (got " + quoted(printable(word)) + ")");
    }
  }
  if (!fs::is_regular_file(words.front()) || access(words.front().c_str(), X_OK) != 0)
    throw InputError("ADAPTER: expected an executable program (got " +
                     quoted(printable(words.front())) + ")");
  return words;
}

OtherSolver adapter_solver(const Adapter& adapter) {
  OtherSolver solver;
  solver.hash = "adapter";
  for (const std::string& word : adapter.words) solver.hash += " " + word + " " + file_hash(word);
  solver.compute = [adapter](const Case& owner, const std::string& variant,
                             const Document& document, const std::vector<Check>& checks,
                             bool with_sweeps, Run& run) {
    const fs::path folder = adapter.folder / owner.id() / variant;
    Json json;
    try {
      json = export_case(owner, {variant});
    } catch (const InputError& refused) {
      return end_as(run, Status::not_exported, remove_file_name(one_line(refused.what())));
    }
    call(adapter, folder, json, run);
    if (run.is_solved() && with_sweeps && run.solver.element_order)
      run.sweeps = swept(adapter, folder, owner, variant, document, checks, run);
  };
  // A call of an adapter is stopped at its limit of wall time. This limit of processor time only
  // applies if stopping the adapter fails.
  solver.time_limit_s = static_cast<unsigned>(std::min(64 * adapter.limits.wall_s + 1, 1e7));
  return solver;
}

namespace {

constexpr std::uintmax_t kMaxAnswerBytes = std::uintmax_t{64} << 20;

/// Returns name, unit and length of a requested quantity. For other quantities that trammel
/// defines, returns only the unit.
Json requested_quantity(const Json& asked, const std::string& name, const InputError& unknown) {
  const Json& all = asked.at("quantities");
  const auto found =
      std::ranges::find_if(all, [&](const Json& one) { return one.at("name") == name; });
  if (found != all.end()) return *found;
  if (results::find_quantity_definition(name, "") == nullptr) throw unknown;
  return {{"unit", unit_of(name)}};
}

Quantity read_quantity(const Json& given, const Json& asked, const std::string& file,
                       const std::string& pointer) {
  if (given.at("unit") != asked.at("unit"))
    throw InputError(file, pointer + "/unit",
                     "expected " + quoted(asked.at("unit").get<std::string>()) + " (got " +
                         quoted(printable(given.at("unit").get<std::string>())) + ")");
  Quantity quantity;
  const Json& values = given.at("values");
  quantity.values = values.is_array() ? values.get<std::vector<double>>()
                                      : std::vector<double>{values.get<double>()};
  const Json length = asked.value("length", Json());
  if (length.is_number() && length != quantity.values.size())
    throw InputError(file, pointer + "/values",
                     "expected " + length.dump() + " numbers (got " +
                         std::to_string(quantity.values.size()) + ")");
  return quantity;
}

}  // namespace

void read_adapter_answer(const std::filesystem::path& file, const Json& requested, Run& run) {
  const std::string name = file.filename().string();
  std::error_code error;
  const auto bytes = std::filesystem::file_size(file, error);
  if (error) throw InputError(name, "", "the adapter has not written this file; expected a result");
  if (bytes > kMaxAnswerBytes)
    throw InputError(name, "", "the file is too large; expected at most 64 MiB");
  const Json json = parse_json(read_text(file), name);
  if (const auto fault = find_schema_fault(json, "adapter_result"))
    throw InputError(name, fault->pointer, fault->message);
  auto status = json.at("status").get<std::string>();
  std::ranges::replace(status, '_', '-');
  run.status = results::from_json<results::Status>(status);
  run.reason = one_line(json.value("reason", ""));
  if (json.contains("solver")) {
    const Json& solver = json.at("solver");
    run.solver = {solver.at("name").get<std::string>(), solver.value("version", ""), {}, {}};
    if (solver.contains("element_order") && !solver.at("element_order").is_null())
      run.solver.element_order = solver.at("element_order").get<double>();
    if (solver.contains("digits") && !solver.at("digits").is_null())
      run.solver.digits = solver.at("digits").get<int>();
  }
  std::vector<std::string> known;
  for (const Json& one : requested.at("quantities")) known.push_back(one.at("name"));
  const Json quantities = json.value("quantities", Json::object());
  for (const auto& item : quantities.items()) {
    const std::string pointer = (JsonPointer("/quantities") / item.key()).to_string();
    const InputError unknown(
        name, pointer, "trammel has no quantity of this name" + did_you_mean(item.key(), known));
    run.quantities[item.key()] = read_quantity(
        item.value(), requested_quantity(requested, item.key(), unknown), name, pointer);
  }
  if (json.contains("cost") && json.at("cost").contains("seconds"))
    run.cost.timings = {{"solver", json.at("cost").at("seconds").get<double>(), 1}};
}

}  // namespace trammel::harness
