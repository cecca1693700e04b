#include <array>

#include "harness/base/find_or_add.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::array<const char*, 5> kEvidence = {"exact", "published", "manufactured", "code",
                                                  "self-consistency"};

/// Returns a table of the program features of one group: keys of a case file, pairs of an analysis
/// and a component of the model, or quantities. Features without independent evidence are first.
Data feature_data(const std::vector<CoverageRow>& rows, const std::string& group,
                  const std::string& title) {
  TextTable table{title, {"Feature"}};
  table.heads.insert(table.heads.end(), kEvidence.begin(), kEvidence.end());
  table.heads.insert(table.heads.end(), {"Series judged", "Reason for no independent evidence"});
  std::size_t verified = 0, with_reason = 0;
  for (const bool is_verified : {false, true})
    for (const CoverageRow& row : rows) {
      if (row.group != group || row.is_verified() != is_verified) continue;
      if (is_verified) ++verified;
      if (!row.reason.empty()) ++with_reason;
      std::vector<std::string>& cells = table.rows.emplace_back();
      cells = {row.feature};
      for (const char* kind : kEvidence)
        cells.emplace_back(harness::contains(row.evidence, kind) ? "●" : "");
      cells.push_back(row.series ? std::to_string(row.judged) + " of " + std::to_string(row.series)
                                 : "");
      cells.push_back(row.reason);
    }
  Data data = table_data(table);
  set(data, {{"count", std::to_string(verified) + " of " + std::to_string(table.rows.size()) +
                           " with independent evidence, " + std::to_string(with_reason) +
                           " without, for a recorded reason"},
             {"verified", std::to_string(verified)},
             {"others", std::to_string(table.rows.size() - verified)}});
  return data;
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
  double wall_s = 0, cpu_s = 0;
  for (const Run& run : results.runs) wall_s += run.cost.wall_s, cpu_s += run.cost.cpu_s;
  const std::string runs = count(results.runs.size(), "run");
  if (!results.runs.empty())
    add("computing time", duration(wall_s) + " for " + runs +
                              ", one after another; processor time " + duration(cpu_s));
  if (from.stored_runs > 0)
    add("not computed anew",
        std::to_string(from.stored_runs) + " of " + runs + " with unchanged input");
  if (results.solver) add("computed by", results.solver->name + " " + results.solver->version);
  data.set("rows", rows);
  return data;
}

Data call_history_section(const Results& results, const StudyFigures& figures) {
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

Data coverage_section(const Results& results) {
  const auto& rows = results.coverage;
  Data groups = list();
  groups.push_back(feature_data(rows, "key", "Keys and values of a case"));
  groups.push_back(feature_data(rows, "pair", "Types of analysis with parts, elements and joints"));
  groups.push_back(feature_data(rows, "quantity", "Quantities"));
  int verified = 0, series = 0, judged = 0;
  for (const CoverageRow& row : rows) {
    verified += row.is_verified() ? 1 : 0;
    series += row.series;
    judged += row.judged;
  }
  return object({{"has_rows", !rows.empty()},
                 {"groups", groups},
                 {"words", std::to_string(verified) + " of " + std::to_string(rows.size()) +
                               " features have independent evidence; " + std::to_string(judged) +
                               " of " + std::to_string(series) + " recorded series are judged."}});
}

}  // namespace trammel::reports
