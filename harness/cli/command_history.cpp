#include "harness/cli/command_history.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include "harness/base/data_root.h"
#include "harness/base/errors.h"
#include "harness/base/json_file.h"
#include "harness/base/processes.h"
#include "harness/base/progress.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/base/timing.h"
#include "harness/run/history.h"
#include "harness/studies/slow_down.h"

namespace trammel::harness {
namespace {

namespace fs = std::filesystem;

void print_changes(const std::vector<HistoryChange>& changes, const std::string& title) {
  if (changes.empty()) return;
  std::cout << title << '\n';
  Table table({"what", "verdict", ">before", ">now", "since commit", "of"});
  const auto text = [](const results::Number& value) { return value ? rounded(*value, 10) : "-"; };
  for (const HistoryChange& change : changes)
    table.add(
        {change.name,
         change.of_verdict() ? change.verdict_before + " to " + change.verdict : change.verdict,
         text(change.before), text(change.after), change.commit, change.date});
  table.print(std::cout, "  ");
}

void print(const History& history) {
  constexpr std::size_t kNewest = 12;
  Table table({">call", "date", "commit", "machine", ">runs", ">checks", ">failures", ">time [s]",
               ">work"});
  const std::size_t all = history.calls.size();
  for (std::size_t i = all > kNewest ? all - kNewest : 0; i < all; ++i) {
    const HistoryCall& call = history.calls[i];
    table.add({std::to_string(call.id), call.date, call.commit, call.machine,
               std::to_string(call.runs), std::to_string(call.checks),
               std::to_string(call.failures), call.cpu_s > 0 ? rounded(call.cpu_s, 3) : "-",
               std::to_string(call.work)});
  }
  table.print(std::cout);
  const std::string since = "call " + std::to_string(history.since);
  if (history.since == 0) {
    std::cout << "No green call before the newest to compare with.\n";
  } else if (history.changes.empty() && history.work.empty()) {
    std::cout << "Nothing has changed since " << since << ", the last green one.\n";
  }
  print_changes(history.changes, "Changed since " + since + ", the last green one:");
  print_changes(history.work, "Counted work changed since " + since + ":");
  for (const HistoryDrift& drift : history.drifts)
    std::cout << "Slow drift in " << drift.steps << " steps: " << drift.name << ", "
              << rounded(drift.first, 10) << " to " << rounded(drift.last, 10) << '\n';
}

constexpr std::size_t kUsualRepeats = 21;

/// A folder that goes when it is no longer needed.
struct TemporaryFolder {
  std::string path = (fs::temp_directory_path() / "trammel-slower-XXXXXX").string();
  TemporaryFolder() {
    if (mkdtemp(path.data()) == nullptr)
      throw InputError(path + ": expected a folder that can be written");
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
};

/// Processor time of a program that runs a case, with all its processes [s].
double time_of(const std::string& program, const std::string& file, const std::string& out) {
  std::vector<std::string> words = {program, "run", file, "--jobs", "1", "--out", out};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage used{};
  if (child < 0 || wait4(child, &status, 0, &used) < 0)
    throw InputError(program + ": expected a program that can be started");
  if (WIFSIGNALED(status)) throw Interrupted(WTERMSIG(status));
  if (WEXITSTATUS(status) > 1)
    throw InputError(program + ": expected a program that runs " + file + " (it ends with " +
                     std::to_string(WEXITSTATUS(status)) + ")");
  return cpu_time_s(used);
}

/// Repeat by repeat all cases, by both programs one after the other, which first is drawn by lot.
std::vector<InterleavedTimes> measure(const std::string& own, const std::string& other,
                                      const std::vector<Case>& cases, std::size_t repeats) {
  const TemporaryFolder folder;
  // From one place and with the same data: where a program lies decides what it looks for.
  const std::vector<std::string> programs = {folder.path + "/a", folder.path + "/b"};
  fs::copy_file(own, programs[0]);
  fs::copy_file(other, programs[1]);
  setenv("TRAMMEL_HOME", data_root().c_str(), 1);
  Progress progress("repeats");
  std::vector<InterleavedTimes> times;
  for (const Case& given : cases) times.push_back({given.id(), {}, {}});
  std::uint64_t state = 1;
  for (std::size_t repeat = 0; repeat <= repeats; ++repeat) {  // the first one warms up
    for (const std::size_t i : shuffled(cases.size(), state)) {
      const std::string file = cases[i].file.string();
      double after = 0, before = 0;
      for (const std::size_t which : shuffled(2, state))
        (which == 0 ? after : before) = time_of(programs[which], file, folder.path);
      if (repeat == 0) continue;
      times[i].after_s.push_back(after);
      times[i].before_s.push_back(before);
    }
    progress.show(repeat, repeats);
  }
  return times;
}

}  // namespace

int history_command(const std::string& file, bool json) {
  const History history = read_history(file);
  if (json) {
    std::cout << pretty(results::history_to_json(history), 3);
  } else {
    print(history);
  }
  return history.calls.empty() || history.calls.back().green() ? 0 : 1;
}

int slower_command(const SlowerCommand& command, const RunCommand& selection) {
  std::error_code error;
  const std::string other = fs::absolute(command.program).string();
  if (!fs::is_regular_file(other, error))
    throw InputError(command.program + ": expected a program, another build of trammel");
  const std::vector<Case> cases = select_cases(selection);
  const std::size_t fewest = fewest_repeats(cases.size());
  const std::size_t repeats =
      command.repeats > 0 ? command.repeats : std::max(kUsualRepeats, fewest + 6);
  if (repeats < fewest)
    throw InputError("--repeats: expected at least " + std::to_string(fewest) + " for " +
                     std::to_string(cases.size()) + " cases (got " + std::to_string(repeats) + ")");
  const auto times = measure(fs::read_symlink("/proc/self/exe").string(), other, cases, repeats);
  Json json = Json::array();
  Table table({"case", ">of the other's time", ">from", ">to", ""});
  std::size_t slower = 0;
  for (const RelativeSpeed& speed : relative_speeds(times)) {
    slower += speed.slower() ? 1 : 0;
    const std::string word = speed.slower() ? "slower" : speed.faster() ? "faster" : "";
    table.add(
        {speed.name, rounded(speed.ratio, 4), rounded(speed.low, 4), rounded(speed.high, 4), word});
    json.push_back({{"case", speed.name},
                    {"ratio", speed.ratio},
                    {"low", speed.low},
                    {"high", speed.high},
                    {"verdict", word}});
  }
  if (command.json) {
    std::cout << pretty(json);
  } else {
    table.print(std::cout);
    std::cout << slower << " of " << cases.size() << (cases.size() == 1 ? " case is" : " cases are")
              << " slower; " << repeats
              << " interleaved repeats, any false word has a probability of 1 %\n";
  }
  return slower > 0 ? 1 : 0;
}

}  // namespace trammel::harness
