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
    Data row = object();
    row.set("call", std::to_string(calls[i].id));
    row.set("date", calls[i].date);
    row.set("commit", calls[i].commit);
    row.set("machine", calls[i].machine);
    row.set("checks", std::to_string(calls[i].checks));
    row.set("failures", std::to_string(calls[i].failures));
    row.set("time", calls[i].cpu_s > 0 ? trimmed(calls[i].cpu_s, 3) + "\u202fs" : "–");
    row.set("work", std::to_string(calls[i].work));
    rows.push_back(row);
  }
  return rows;
}

Data changes_of(const History& history) {
  Data rows = list();
  for (const auto* changes : {&history.changes, &history.work})
    for (std::size_t i = 0; i < changes->size() && i < kShownChanges; ++i) {
      const HistoryChange& change = (*changes)[i];
      Data row = object();
      row.set("name", change.name + (changes == &history.work ? ", counted work" : ""));
      row.set("verdict", change.of_verdict() ? change.verdict_before + " to " + change.verdict
                                             : change.verdict);
      row.set("before", text_of(change.before));
      row.set("after", text_of(change.after));
      row.set("commit", change.commit);
      rows.push_back(row);
    }
  return rows;
}

}  // namespace

Data history_section(const Results& results, const std::optional<Figure>& figure) {
  Data section = object();
  const bool any = results.history && !results.history->calls.empty();
  set_flag(section, "has_rows", any);
  if (!any) return section;
  const History& history = *results.history;
  const std::size_t changes = history.changes.size() + history.work.size();
  std::string words = count(history.calls.size(), "call") + "; ";
  words += history.since == 0
               ? "no green one before the newest to compare with."
               : (changes == 0 ? std::string("nothing has")
                               : count(changes, "value") + (changes == 1 ? " has" : " have")) +
                     " changed since call " + std::to_string(history.since) +
                     ", the last green one.";
  section.set("words", words);
  section.set("figure", figure ? figure_data(*figure) : Data(Data::type::bool_false));
  section.set("calls", calls_of(history));
  section.set("changes", changes_of(history));
  set_flag(section, "has_changes", changes > 0);
  Data drifts = list();
  for (const HistoryDrift& drift : history.drifts) {
    Data row = object();
    row.set("name", drift.name);
    row.set("course", trimmed(drift.first, 9) + " to " + trimmed(drift.last, 9) + " in " +
                          count(drift.steps, "step"));
    drifts.push_back(row);
  }
  section.set("drifts", drifts);
  return section;
}

}  // namespace trammel::reports
