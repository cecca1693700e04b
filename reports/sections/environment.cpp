#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Returns the computing time of all runs.
std::string time_text(const Results& results) {
  double wall_s = 0, cpu_s = 0;
  for (const Run& run : results.runs) wall_s += run.cost.wall_s, cpu_s += run.cost.cpu_s;
  return duration(wall_s) + " for " + count(results.runs.size(), "run") +
         ", one after another; processor time " + duration(cpu_s);
}

}  // namespace

Data environment_section(const Results& results) {
  const Environment& from = results.environment;
  const std::pair<const char*, std::string> entries[] = {
      {"trammel", from.trammel},     {"commit", from.commit},
      {"date", from.date},           {"compiler", from.compiler},
      {"build", from.build_type},    {"flags", from.flags},
      {"processor", from.processor}, {"cores", std::to_string(from.cores)},
      {"system", from.system}};
  Data data = object(), rows = list();
  const auto add = [&](const std::string& key, const std::string& value) {
    if (!value.empty()) rows.push_back(object({{"key", key}, {"value", value}}));
  };
  for (const auto& [key, value] : entries) {
    set(data, {{key, value}});
    add(key, value);
  }
  for (const auto& [name, version] : from.libraries) add(name, version);
  if (!results.runs.empty()) add("computing time", time_text(results));
  if (from.stored_runs > 0)
    add("not computed anew", std::to_string(from.stored_runs) + " of " +
                                 std::to_string(results.runs.size()) +
                                 " runs, which an earlier call of the same program computed from "
                                 "the same input; unchanged drawings are kept, too");
  if (results.solver) add("computed by", results.solver->name + " " + results.solver->version);
  data.set("rows", rows);
  return data;
}

Data history_section(const Results& results, const StudyFigures& figures) {
  if (!results.history || results.history->calls.empty()) return object({{"has_rows", false}});
  const History& history = *results.history;
  const std::size_t changes = history.changes.size() + history.work.size();
  const std::string since = history.since == 0
                                ? "no earlier call without failures."
                                : (changes == 0 ? "no value" : count(changes, "value")) +
                                      " changed since call " + std::to_string(history.since) +
                                      ", the last one without failures.";
  return object({{"has_rows", true},
                 {"words", count(history.calls.size(), "call") + "; " + since},
                 {"figures", list_of(figures.history, figure_data)}});
}

}  // namespace trammel::reports
