#include "harness/cli/command_history.h"

#include <algorithm>
#include <iostream>

#include "harness/base/json_file.h"
#include "harness/base/table.h"
#include "harness/base/text.h"
#include "harness/run/history.h"

namespace trammel::harness {
namespace {

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

}  // namespace trammel::harness
