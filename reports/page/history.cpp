#include "reports/page/history.h"

#include "reports/sections/family.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kShownCalls = 12, kShownChanges = 40;

std::string text_of(const Number& value) {
  return value ? trimmed(*value, 9) : "–";
}

Data calls_of(const History& history) {
  Data rows = list();
  const auto& calls = history.calls;
  for (std::size_t i = calls.size(); i-- > 0 && calls.size() - i <= kShownCalls;) {
    rows.push_back(
        object({{"call", std::to_string(calls[i].id)},
                {"date", calls[i].date},
                {"commit", calls[i].commit},
                {"machine", calls[i].machine},
                {"checks", std::to_string(calls[i].checks)},
                {"failures", std::to_string(calls[i].failures)},
                {"time", calls[i].cpu_s > 0 ? trimmed(calls[i].cpu_s, 3) + "\u202fs" : "–"},
                {"work", std::to_string(calls[i].work)}}));
  }
  return rows;
}

Data changes_of(const History& history) {
  Data rows = list();
  for (const auto* changes : {&history.changes, &history.work})
    for (std::size_t i = 0; i < changes->size() && i < kShownChanges; ++i) {
      const HistoryChange& change = (*changes)[i];
      rows.push_back(
          object({{"name", change.name + (changes == &history.work ? ", counted work" : "")},
                  {"verdict", change.of_verdict() ? change.verdict_before + " to " + change.verdict
                                                  : change.verdict},
                  {"before", text_of(change.before)},
                  {"after", text_of(change.after)},
                  {"commit", change.commit}}));
    }
  return rows;
}

}  // namespace

Data history_section(const Results& results, const std::optional<Figure>& figure) {
  if (!results.history || results.history->calls.empty()) return object({{"has_rows", false}});
  const History& history = *results.history;
  const std::size_t changes = history.changes.size() + history.work.size();
  std::string words = count(history.calls.size(), "call") + "; ";
  words += history.since == 0
               ? "no green one before the newest to compare with."
               : (changes == 0 ? std::string("nothing has")
                               : count(changes, "value") + (changes == 1 ? " has" : " have")) +
                     " changed since call " + std::to_string(history.since) +
                     ", the last green one.";
  const auto drift_data = [](const HistoryDrift& drift) {
    return object({{"name", drift.name},
                   {"course", trimmed(drift.first, 9) + " to " + trimmed(drift.last, 9) + " in " +
                                  count(drift.steps, "step")}});
  };
  return object({{"has_rows", true},
                 {"words", words},
                 {"figure", figure ? figure_data(*figure) : Data(false)},
                 {"calls", calls_of(history)},
                 {"changes", changes_of(history)},
                 {"has_changes", changes > 0},
                 {"drifts", list_of(history.drifts, drift_data)}});
}

}  // namespace trammel::reports
