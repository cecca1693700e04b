#include <algorithm>
#include <set>

#include "reports/check_text.h"
#include "reports/number.h"
#include "reports/sections.h"

namespace trammel::reports {

namespace {

struct Role {
  const char *name, *meaning;
};
constexpr std::array<Role, 3> roles = {{
    {"verification", "against exact or independent truth"},
    {"validation", "against the published results under examination"},
    {"regression", "against our own earlier results"},
}};

Counts counts_of(const Results& results, const std::string& role) {
  Counts counts;
  for (const Run& run : results.runs)
    for (const Check& check : run.checks)
      if (role.empty() || check.role == role) ++counts[standing(check)];
  return counts;
}

Data role_row(const std::string& name, const std::string& meaning, const Counts& counts) {
  Data row = object();
  row.set("role", name);
  set_text(row, "meaning", meaning);
  Data cells = list();
  for (const Standing which : all_standings) {
    Data cell = object();
    const std::size_t n = count_of(counts, which);
    set_standing(cell, which);
    set_text(cell, "n", n ? std::to_string(n) : "");
    cells.push_back(cell);
  }
  row.set("cells", cells);
  row.set("total", std::to_string(total(counts)));
  return row;
}

Data role_table(const Results& results) {
  Data rows = list();
  for (const Role& role : roles) {
    const Counts counts = counts_of(results, role.name);
    if (total(counts) > 0) rows.push_back(role_row(role.name, role.meaning, counts));
  }
  rows.push_back(role_row("all", "", counts_of(results, "")));
  return rows;
}

Data item(const CaseInfo& info, const Run& run, const std::string& what, const std::string& text) {
  Data data = object();
  data.set("case_title", info.title);
  data.set("case_anchor", case_anchor(info.id));
  set_text(data, "variant_title", info.variants.size() > 1 ? info.variant_title(run.variant) : "");
  set_text(data, "what", what);
  set_text(data, "text", text);
  return data;
}

/// Runs that did not end as their case expects, and checks that fail or could not be judged.
Data troubles(const Results& results, std::size_t& runs_without) {
  Data out = list();
  for (const Run& run : results.runs) {
    const CaseInfo& info = results.case_info(run.case_id);
    const Standing ending = standing(run);
    if (ending == Standing::fails || ending == Standing::error) {
      ++runs_without;
      Data data = item(info, run, to_string(run.status), run.reason);
      set_standing(data, ending);
      out.push_back(data);
    }
    for (const CheckGroup& group : group_checks(run)) {
      const Standing worst = standing(group.worst());
      if (worst != Standing::fails && worst != Standing::error) continue;
      Data data = item(info, run, group.front().name, trouble_text(group));
      set_standing(data, worst);
      out.push_back(data);
    }
  }
  return out;
}

/// Known discrepancies under one name, with one reference and one reason: all cases of a family,
/// variants and entries together.
struct Known {
  std::vector<const CaseInfo*> cases;
  const Check* least;
  const Check* most;
  std::size_t checks = 0;
  std::set<const Run*> runs;
};

bool same_discrepancy(const Known& known, const CaseInfo& info, const Check& check) {
  const Check& other = *known.least;
  return known.cases.front()->family == info.family && other.name == check.name &&
         other.reference == check.reference && other.measure == check.measure &&
         other.why == check.why;
}

std::vector<Known> known_discrepancies(const Results& results) {
  std::vector<Known> out;
  for (const Run& run : results.runs) {
    for (const Check& check : run.checks) {
      if (standing(check) != Standing::known) continue;
      const CaseInfo& info = results.case_info(run.case_id);
      auto known = std::find_if(out.begin(), out.end(),
                                [&](const Known& k) { return same_discrepancy(k, info, check); });
      if (known == out.end()) known = out.insert(out.end(), Known{{&info}, &check, &check, 0, {}});
      ++known->checks;
      known->runs.insert(&run);
      if (known->cases.back() != &info) known->cases.push_back(&info);
      if (check.difference < known->least->difference) known->least = &check;
      if (check.difference > known->most->difference) known->most = &check;
    }
  }
  return out;
}

std::string span_text(const Known& known) {
  if (!known.least->difference || !known.most->difference) return "";
  const std::string low = difference_text(*known.least, *known.least->difference);
  const std::string high = difference_text(*known.most, *known.most->difference);
  return low == high ? low : low + " to " + high;
}

Data known_list(const Results& results) {
  Data out = list();
  for (const Known& known : known_discrepancies(results)) {
    Data data = object();
    const Reference* reference = results.reference(known.least->reference);
    Data cases = list();
    for (const CaseInfo* info : known.cases) {
      Data entry = object();
      entry.set("case_title", info->title);
      entry.set("case_anchor", case_anchor(info->id));
      cases.push_back(entry);
    }
    data.set("cases", cases);
    data.set("what", reference ? reference->title : known.least->name);
    set_text(data, "reference_anchor", reference ? reference_anchor(reference->id) : "");
    set_text(data, "span", span_text(known));
    std::string extent = count(known.checks, "check");
    if (known.runs.size() > 1) extent += " of " + count(known.runs.size(), "variant");
    data.set("extent", extent);
    set_text(data, "reason", known.least->why);
    out.push_back(data);
  }
  return out;
}

std::string verdict_words(const Counts& counts, std::size_t runs_without) {
  const std::size_t fails = count_of(counts, Standing::fails);
  const std::size_t errors = count_of(counts, Standing::error);
  if (total(counts) == 0) return "Nothing was checked.";
  std::string text;
  const auto add_part = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (fails > 0) add_part(count(fails, "check fails", "checks fail"));
  if (errors > 0) add_part(std::to_string(errors) + " could not be judged");
  if (runs_without > 0)
    add_part(count(runs_without, "run did not end as expected", "runs did not end as expected"));
  return text.empty() ? "Every gate holds." : text + ".";
}

std::string overview_words(const Results& results, const std::vector<Family>& families,
                           const Counts& counts) {
  std::size_t cases = 0;
  for (const Family& family : families) cases += family.cases.size();
  std::string text = count(cases, "case") + " in " + count(families.size(), "family", "families") +
                     " were solved in " + count(results.runs.size(), "variant") + " and " +
                     count(total(counts), "check") + " made. ";
  text += count(count_of(counts, Standing::holds), "check holds", "checks hold") +
          " within a reasoned tolerance.";
  if (const std::size_t known = count_of(counts, Standing::known))
    text += " " + count(known, "comparison is", "comparisons are") + " known not to agree and " +
            (known == 1 ? "does" : "do") + " not, by as much as recorded; the reasons are below.";
  if (const std::size_t skipped = count_of(counts, Standing::not_run))
    text += " " + count(skipped, "check was", "checks were") + " not run.";
  return text;
}

}  // namespace

Data summary_section(const Results& results, const std::vector<Family>& families) {
  const Counts counts = counts_of(results, "");
  std::size_t runs_without = 0;
  Data summary = object();
  const Data trouble_list = troubles(results, runs_without);
  const bool good = gate_holds(counts) && runs_without == 0 && total(counts) > 0;
  summary.set("verdict", verdict_words(counts, runs_without));
  summary.set("verdict_class", good ? "holds" : "fails");
  summary.set("overview", overview_words(results, families, counts));
  summary.set("bar", counts_list(counts));
  summary.set("roles", role_table(results));
  set_flag(summary, "has_troubles", trouble_list.is_non_empty_list());
  summary.set("troubles", trouble_list);
  const Data known = known_list(results);
  set_flag(summary, "has_known", known.is_non_empty_list());
  summary.set("known", known);
  Data heads = list();
  for (const Standing which : all_standings) {
    Data head = object();
    set_standing(head, which);
    heads.push_back(head);
  }
  summary.set("heads", heads);
  return summary;
}

}  // namespace trammel::reports
