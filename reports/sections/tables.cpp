#include <algorithm>
#include <ranges>
#include <set>

#include "harness/base/find_or_add.h"
#include "harness/results/quantity_definitions.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

constexpr std::size_t kMaxHeadlines = 8;  ///< rows of a case that are visible at once
constexpr std::size_t kMaxEntries = 12;   ///< of checks with more values, the worst is shown

/// Returns the table cells of one value. The first row also has the cells that span all rows.
Data row_of(const Check& check, const std::string& entry, bool first = true) {
  const bool has_message = check.verdict != Verdict::pass || check.measure == "status";
  return status_data(find_status(check), {{"entry", entry},
                                          {"long_entry", entry.size() > 24},
                                          {"target", target_text(check)},
                                          {"computed", computed_text(check)},
                                          {"difference", difference_text(check)},
                                          {"message", has_message ? check.message : ""},
                                          {"own_range", ""},
                                          {"first", first}});
}

/// Returns the tolerance as text. The text is empty for a bound, because the column of targets
/// shows the limits of the bound.
std::string range_text(const Check& check) {
  if (check.measure == "status" || (check.measure == "bound" && !check.expected)) return "";
  return (check.is_known_discrepancy() ? "expected " : "") + tolerance_text(check);
}

/// State of a table under construction: the results, and the names of checks that have an anchor
/// (link target) on the page.
struct Rows {
  const Results& results;
  std::set<std::string> named = {};
};

/// Returns the data of one check with a row for each value.
/// @param shared  true if all rows have the same tolerance, which is then stated once
Data group_data(const Check& check, Rows& table, const Data& rows, bool shared) {
  const bool first = table.named.insert(check.name).second;
  std::size_t n = rows.list_value().size();
  for (const Data& row : rows.list_value()) n += row.get("message")->is_string() ? 1 : 0;
  const QuantityDefinition* definition = find_quantity_definition(check.quantity, "");
  const Reference* reference = table.results.reference(check.reference);
  return object({{"check_anchor", first ? slug(check.name) : ""},
                 {"rows", rows},
                 {"rowspan", std::to_string(n)},
                 {"name", check_title(check)},
                 {"quantity", quantity_text(check)},
                 {"meaning", definition == nullptr ? "" : definition->meaning},
                 {"shared", shared},
                 {"range", range_text(check)},
                 {"why", check.why},
                 {"reference", reference ? reference->title : check.reference},
                 {"reference_link", reference ? reference_link(reference->id) : ""}});
}

/// Returns "worst of 631: point 12", for a check of many values, of which the worst is shown.
std::string worst_entry_text(const Check& worst, std::size_t entries) {
  const std::string entry = entry_text(worst, entries);
  return "worst of " + std::to_string(entries) + (entry.empty() ? "" : ": " + entry);
}

Data one_row_group(const Check& worst, const std::string& entry, Rows& table) {
  Data rows = list();
  rows.push_back(row_of(worst, entry));
  return group_data(worst, table, rows, true);
}

bool have_same_reason(const Check& a, const Check& b) {
  return a.why == b.why && a.reference == b.reference;
}

/// Adds a row for each value of a check, or only for its worst value if there are more than
/// kMaxEntries. Values with different references, or different reasons for their tolerances, form
/// separate groups.
void add_check_groups(Data& groups, const CheckGroup& group, Rows& table) {
  if (group.checks.size() > kMaxEntries) {
    const Check& worst = group.worst();
    groups.push_back(one_row_group(worst, worst_entry_text(worst, group.checks.size()), table));
    return;
  }
  for (std::size_t from = 0, to = 0; from < group.checks.size(); from = to) {
    const Check& first = *group.checks[from];
    bool shared = true;
    for (to = from; to < group.checks.size() && have_same_reason(first, *group.checks[to]); ++to)
      shared = shared && range_text(first) == range_text(*group.checks[to]);
    Data rows = list();
    for (std::size_t i = from; i < to; ++i) {
      const Check& check = *group.checks[i];
      Data row = row_of(check, entry_text(check, group.checks.size()), i == from);
      set(row, {{"own_range", shared ? "" : range_text(check)}});
      rows.push_back(row);
    }
    groups.push_back(group_data(first, table, rows, shared));
  }
}

Data template_data_of_run(const CaseInfo& info, const Run& run, bool many) {
  return status_data(
      find_status(run),
      {{"variant", many ? info.variant_title(run.variant) : ""},
       {"variant_anchor", slug(run.variant)},
       {"run_words", run_name(info) + (run.variant == "base" ? "" : " --variant " + run.variant)},
       {"ending", run.status == Status::solved ? "" : to_string(run.status)},
       {"reason", run.reason}});
}

Data table_of_all_checks(const CaseInfo& info, const std::vector<const Run*>& runs, Rows& rows) {
  Data table = list();
  for (const Run* run : runs) {
    // A solved variant without checks, such as a baseline of other variants, has no rows.
    if (run->checks.empty() && run->status == Status::solved) continue;
    Data data = template_data_of_run(info, *run, runs.size() > 1);
    Data groups = list();
    for (const CheckGroup& group : group_checks(*run)) add_check_groups(groups, group, rows);
    data.set("groups", groups);
    table.push_back(data);
  }
  return table;
}

/// Returns the worst values of checks over all variants, the most severe checks first.
Data table_of_worst_checks(const CaseInfo& info, const std::vector<const Run*>& runs, Rows& rows) {
  struct Worst {
    const Check* check;
    const Run* run;
    std::size_t entries;
  };
  std::vector<Worst> worst;
  for (const Run* run : runs)
    for (const CheckGroup& group : group_checks(*run)) {
      const Check& check = group.worst();
      const auto same = [&](const Worst& known) {
        return known.check->name == check.name && known.check->quantity == check.quantity;
      };
      Worst& known = harness::find_or_add(worst, same, {&check, run, 0});
      known.entries += group.checks.size();
      if (is_worse_than(check, *known.check)) known.check = &check, known.run = run;
    }
  std::ranges::stable_sort(
      worst, [](const Worst& a, const Worst& b) { return is_worse_than(*a.check, *b.check); });
  Data groups = list();
  for (const Worst& w : worst | std::views::take(kMaxHeadlines)) {
    std::string entry =
        w.entries > 1 ? worst_entry_text(*w.check, w.entries) : entry_text(*w.check, w.entries);
    if (runs.size() > 1) add_item(entry, info.variant_title(w.run->variant));
    Data group = one_row_group(*w.check, entry, rows);
    set(group, {{"uncertainty", uncertainty_text(*w.run, *w.check)}});
    if (!w.check->title.empty())  // the title names the quantity
      set(group, {{"quantity", axis_label("", display_unit(w.check->unit))}});
    groups.push_back(group);
  }
  return groups;
}

}  // namespace

Data case_check_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                       const Results& results) {
  std::size_t checks = 0;
  for (const Run* run : runs) checks += run->checks.size();
  std::string title = "All checks: " + count(checks, "number");
  if (runs.size() > 1) title += " of " + count(runs.size(), "variant");
  Rows rows{results};
  return object({{"has_checks", checks > 0},
                 {"headlines", table_of_worst_checks(info, runs, rows)},
                 {"title", title},
                 {"runs", table_of_all_checks(info, runs, rows)}});
}

Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs) {
  Table table;
  table.heads = words_in(
      "case variant status check role quantity index unit target computed measure difference "
      "tolerance_low tolerance_high expectation reference verdict message discretization_error "
      "u_num u_input u_reference u_val dominant_input");
  for (const Run* run : runs)
    for (const Check& c : run->checks) {
      const bool is_entry = c.index && c.statistic.empty();
      const Number error =
          is_entry ? run->error_half_width(c.quantity, static_cast<std::size_t>(*c.index))
                   : Number();
      const Tolerance range = c.tolerance.value_or(Tolerance());
      const Comparison* found = find_comparison(*run, c);
      const Comparison entry = found != nullptr ? *found : Comparison();
      auto& row = table.rows.emplace_back();
      const auto add = [&](const std::vector<harness::Json>& cells) {
        row.insert(row.end(), cells.begin(), cells.end());
      };
      add({info.id, run->variant, to_string(run->status), c.name, c.role, c.quantity});
      add({number_or_null(c.index ? Number(*c.index + 1) : Number()), c.unit,
           number_or_null(c.expected)});
      add({number_or_null(c.computed), c.measure, number_or_null(c.difference),
           number_or_null(range.low), number_or_null(range.high)});
      add({std::string(c.is_known_discrepancy() ? "known-discrepancy" : "agrees"), c.reference});
      add({verdict_text(c), c.message, number_or_null(error), number_or_null(entry.u_num),
           number_or_null(entry.u_input)});
      add({number_or_null(entry.u_reference), number_or_null(entry.u_val), entry.dominant_input});
    }
  return table;
}

}  // namespace trammel::reports
