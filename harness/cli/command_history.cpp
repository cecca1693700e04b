#include <iostream>

#include "harness/base/json_file.h"
#include "harness/base/rows.h"
#include "harness/cli/commands.h"
#include "harness/results/result_fields.h"
#include "harness/run/results.h"

namespace trammel::harness {
namespace {

void print_changes(const Json& changes, const std::string& title) {
  if (changes.empty()) return;
  std::cout << title << '\n';
  Rows({{"name", "entry"},
        {"verdict_before", "verdict"},
        {"verdict", "now"},
        {"before", "", 10},
        {"after", "", 10},
        {"commit", "since commit"},
        {"date"}},
       changes)
      .print(std::cout, "  ");
}

void print_history(const Json& history) {
  constexpr std::ptrdiff_t kNewest = 12;
  const Json& calls = history["calls"];
  const auto count = std::min(kNewest, std::ssize(calls));
  Rows({{"id", "call"},
        {"date"},
        {"commit"},
        {"machine"},
        {"runs"},
        {"checks"},
        {"failures"},
        {"cpu_s", "time [s]", 3},
        {"work"}},
       Json(calls.end() - count, calls.end()))
      .print(std::cout);
  const std::string since = "call " + history["since"].dump();
  if (history["since"] == 0) {
    std::cout << "Every recorded call before the newest call has failures.\n";
  } else if (history["changes"].empty() && history["work"].empty()) {
    std::cout << "Nothing has changed since " << since << ", the last call without failures.\n";
  }
  print_changes(history["changes"], "Changed since " + since + ", the last call without failures:");
  print_changes(history["work"], "Counted work changed since " + since + ":");
  if (history["drifts"].empty()) return;
  std::cout << "Values that drift slowly from call to call:\n";
  Rows({{"name"}, {"steps"}, {"first", "", 10}, {"last", "", 10}}, history["drifts"])
      .print(std::cout, "  ");
}

}  // namespace

int history_command(const CommandOptions& options, const Renderers& /*renderers*/) {
  const History history = read_history(options.word);
  const Json json = results::to_json(history);
  if (options.json) {
    std::cout << format_json(json, 3);
  } else {
    print_history(json);
  }
  return history.calls.empty() || history.calls.back().has_passed() ? 0 : 1;
}

}  // namespace trammel::harness
