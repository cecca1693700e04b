#include "reports/sections/tables.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "harness/results/quantity_definitions.h"
#include "reports/data/check_status.h"
#include "reports/data/check_text.h"
#include "reports/drawing/figure.h"
#include "reports/sections/check_status_data.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxUnfoldedChecks = 16;  ///< rows of a case shown without folding
constexpr std::size_t kMaxEntries = 12;         ///< entries of one check shown one by one

/// The cells of one check; the first of its group carries what the group has in common.
Data row_of(const Check& check, const std::string& entry, bool first = true) {
  Data row = object();
  set_text(row, "entry", entry);
  set_flag(row, "long_entry", entry.size() > 24);
  row.set("target", target_text(check));
  row.set("computed", computed_text(check));
  row.set("difference", difference_text(check));
  set_check_status(row, check_status(check));
  const bool telling = check.verdict != Verdict::pass || check.measure == "status";
  set_text(row, "message", telling ? check.message : "");
  set_text(row, "own_range", "");
  set_flag(row, "first", first);
  return row;
}

/// A bound is its own target and need not be said twice.
std::string range_text(const Check& check) {
  if (check.measure == "status" || (check.measure == "bound" && !check.expected)) return "";
  return (check.known_discrepancy() ? "expected " : "") + tolerance_text(check);
}

/// Of a table: what its rows look up, and the names whose first check carries their anchor.
struct Rows {
  const Results& results;
  bool is_linked = false;
  std::set<std::string> named = {};
};

/// One check with all its entries: name, reference and reason stand once for all of them, and so
/// does the tolerance if they share it.
Data group_of(const Check& check, Rows& table, const Data& rows, std::size_t n) {
  Data group = object();
  const bool first = table.is_linked && table.named.insert(check.name).second;
  set_text(group, "check_anchor", first ? slug(check.name) : "");
  group.set("rows", rows);
  for (const Data& row : rows.list_value()) n += row.get("message")->is_string() ? 1 : 0;
  group.set("rowspan", std::to_string(n));
  group.set("name", check_title(check));
  group.set("quantity", quantity_text(check));
  const QuantityDefinition* definition = find_quantity_definition(check.quantity, "");
  set_text(group, "meaning", definition == nullptr ? "" : definition->meaning);
  group.set("role", check.role);
  set_flag(group, "shared", true);
  set_text(group, "range", range_text(check));
  set_text(group, "why", check.why);
  const Reference* reference = table.results.reference(check.reference);
  set_text(group, "reference", reference ? reference->title : check.reference);
  set_text(group, "reference_link", reference ? reference_link(reference->id) : "");
  return group;
}

/// "631 points, 629 hold": for a group of which only the worst is shown.
std::string worst_entry(const CheckGroup& group) {
  const std::string entry = entry_text(group.worst(), group.checks.size());
  return "worst of " + std::to_string(group.checks.size()) + (entry.empty() ? "" : ": " + entry);
}

bool same_reason(const Check& a, const Check& b) {
  return a.why == b.why && a.reference == b.reference;
}

/// Every entry, or the worst of many. Entries with reasons of their own stand apart.
void add_group(Data& groups, const CheckGroup& group, Rows& table) {
  if (group.checks.size() > kMaxEntries) {
    Data rows = list();
    rows.push_back(row_of(group.worst(), worst_entry(group)));
    groups.push_back(group_of(group.worst(), table, rows, 1));
    return;
  }
  for (std::size_t from = 0, to = 0; from < group.checks.size(); from = to) {
    const Check& first = *group.checks[from];
    bool shared = true;
    for (to = from; to < group.checks.size() && same_reason(first, *group.checks[to]); ++to)
      shared = shared && range_text(first) == range_text(*group.checks[to]);
    Data rows = list();
    for (std::size_t i = from; i < to; ++i) {
      const Check& check = *group.checks[i];
      Data row = row_of(check, entry_text(check, group.checks.size()), i == from);
      set_text(row, "own_range", shared ? "" : range_text(check));
      rows.push_back(row);
    }
    Data data = group_of(first, table, rows, to - from);
    set_flag(data, "shared", shared);
    groups.push_back(data);
  }
}

Data run_data(const CaseInfo& info, const Run& run, bool many) {
  Data data = object();
  set_text(data, "variant", many ? info.variant_title(run.variant) : "");
  data.set("variant_anchor", slug(run.variant));
  data.set("run_words", info.id + (run.variant == "base" ? "" : " --variant " + run.variant));
  set_text(data, "ending", run.status == Status::solved ? "" : to_string(run.status));
  set_text(data, "reason", run.reason);
  set_check_status(data, check_status(run));
  return data;
}

/// Rows that `add_group` makes.
std::size_t rows_in(const std::vector<const Run*>& runs) {
  std::size_t n = 0;
  for (const Run* run : runs)
    for (const CheckGroup& group : group_checks(*run))
      n += group.checks.size() > kMaxEntries ? 1 : group.checks.size();
  return n;
}

/// All runs one after another.
Data full_table(const CaseInfo& info, const std::vector<const Run*>& runs, Rows linked) {
  Data table = list();
  for (const Run* run : runs) {
    // A variant that others are measured against, and that ended well, has no rows.
    if (run->checks.empty() && run->status == Status::solved) continue;
    Data data = run_data(info, *run, runs.size() > 1);
    Data groups = list();
    for (const CheckGroup& group : group_checks(*run)) add_group(groups, group, linked);
    data.set("groups", groups);
    table.push_back(data);
  }
  return table;
}

/// For every check the worst of all variants and entries.
Data worst_table(const CaseInfo& info, const std::vector<const Run*>& runs, Rows linked) {
  struct Worst {
    const Check* check;
    const Run* run;
    std::size_t entries;
  };
  std::vector<Worst> worst;
  for (const Run* run : runs) {
    for (const CheckGroup& group : group_checks(*run)) {
      const Check& check = group.worst();
      const auto same = std::ranges::find_if(worst, [&](const Worst& known) {
        return known.check->name == check.name && known.check->quantity == check.quantity;
      });
      if (same == worst.end()) {
        worst.push_back({&check, run, group.checks.size()});
        continue;
      }
      same->entries += group.checks.size();
      if (worse(check, *same->check)) same->check = &check, same->run = run;
    }
  }
  Data groups = list();
  for (const Worst& w : worst) {
    std::string entry = entry_text(*w.check, w.entries);
    if (w.entries > 1)
      entry = "worst of " + std::to_string(w.entries) + (entry.empty() ? "" : ": " + entry);
    if (runs.size() > 1) entry += (entry.empty() ? "" : ", ") + info.variant_title(w.run->variant);
    Data rows = list();
    rows.push_back(row_of(*w.check, entry));
    groups.push_back(group_of(*w.check, linked, rows, 1));
  }
  Data run = object();
  for (const char* key : {"variant", "ending", "reason"}) set_text(run, key, "");
  run.set("groups", groups);
  Data table = list();
  table.push_back(run);
  return table;
}

}  // namespace

Data case_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                 const Results& results) {
  Data tables = object();
  std::size_t checks = 0;
  for (const Run* run : runs) checks += run->checks.size();
  set_flag(tables, "has_checks", checks > 0);
  const bool few = rows_in(runs) <= kMaxUnfoldedChecks;
  tables.set("runs", few ? full_table(info, runs, {results, true})
                         : worst_table(info, runs, {results, true}));
  set_flag(tables, "has_folded", !few);
  if (few) return tables;
  std::string title = "All " + count(checks, "check");
  if (runs.size() > 1) title += " of " + count(runs.size(), "variant");
  tables.set("folded_title", title);
  tables.set("folded_runs", full_table(info, runs, {results}));
  return tables;
}

Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Table table;
  table.heads = words_in(
      "case variant status check role quantity index unit target computed measure difference "
      "tolerance_low tolerance_high expectation reference verdict reason message");
  for (const Run* run : runs)
    for (const Check& c : run->checks)
      table.rows.push_back(
          {info.id, run->variant, to_string(run->status), c.name, c.role, c.quantity,
           c.index ? Table::Cell(static_cast<double>(*c.index + 1)) : Table::Cell{}, c.unit,
           cell(c.expected), cell(c.computed), c.measure, cell(c.difference),
           c.tolerance ? cell(c.tolerance->low) : Table::Cell{},
           c.tolerance ? cell(c.tolerance->high) : Table::Cell{},
           std::string(c.known_discrepancy() ? "known-discrepancy" : "agrees"), c.reference,
           to_string(c.verdict), c.why, c.message});
  return table;
}

}  // namespace trammel::reports
