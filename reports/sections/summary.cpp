#include "reports/sections/summary.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "harness/base/find_or_add.h"
#include "reports/data/check_status.h"
#include "reports/data/check_text.h"
#include "reports/sections/check_status_data.h"
#include "reports/sections/matrix.h"
#include "reports/text/html.h"
#include "reports/text/number.h"
#include "reports/text/words.h"

namespace trammel::reports {

namespace {

using harness::find_or_add;

struct Role {
  const char *name, *meaning;
};
constexpr std::array<Role, 3> kRoles = {{
    {"verification", "against exact or independent reference solutions"},
    {"validation", "against the published results under examination"},
    {"regression", "against our own earlier results"},
}};

Counts counts_of(const Results& results, const std::string& role) {
  Counts counts;
  for (const Run& run : results.runs)
    for (const Check& check : run.checks)
      if (role.empty() || check.role == role) ++counts[check_status(check)];
  return counts;
}

/// All but what few results have and none of these does.
std::vector<CheckStatus> role_columns(const Counts& all) {
  std::vector<CheckStatus> columns;
  for (const CheckStatus which : kAllCheckStatuses)
    if ((which != CheckStatus::not_judged && which != CheckStatus::not_given) ||
        count_of(all, which) > 0)
      columns.push_back(which);
  return columns;
}

Data role_row(const std::string& name, const std::string& meaning, const Counts& counts,
              const std::vector<CheckStatus>& columns) {
  const auto cell = [&](CheckStatus which) {
    const std::size_t n = count_of(counts, which);
    return with_status(which, {{"n", n ? std::to_string(n) : ""}});
  };
  return object({{"role", name},
                 {"meaning", meaning},
                 {"cells", list_of(columns, cell)},
                 {"total", std::to_string(total(counts))}});
}

Data role_table(const Results& results) {
  Data rows = list();
  const Counts all = counts_of(results, "");
  const std::vector<CheckStatus> columns = role_columns(all);
  for (const Role& role : kRoles) {
    const Counts counts = counts_of(results, role.name);
    if (total(counts) > 0) rows.push_back(role_row(role.name, role.meaning, counts, columns));
  }
  rows.push_back(role_row("all", "", all, columns));
  return rows;
}

Data item(const CaseInfo& info, const Run& run, CheckStatus status, const std::string& what,
          const std::string& text) {
  return with_status(
      status, {{"case_title", info.title},
               {"case_link", case_link(info.id)},
               {"variant_title", info.variants.size() > 1 ? info.variant_title(run.variant) : ""},
               {"what", what},
               {"text", text}});
}

bool is_failure(CheckStatus status) {
  return status == CheckStatus::fails || status == CheckStatus::error;
}

/// Runs that did not end as their case expects, and checks that fail or could not be judged.
Data failures(const Results& results, std::size_t& unexpected_endings) {
  Data out = list();
  for (const Run& run : results.runs) {
    const CaseInfo& info = results.case_info(run.case_id);
    const CheckStatus ending = check_status(run);
    if (is_failure(ending)) {
      ++unexpected_endings;
      out.push_back(item(info, run, ending, to_string(run.status), run.reason));
    }
    for (const CheckGroup& group : group_checks(run)) {
      const CheckStatus worst = check_status(group.worst());
      if (is_failure(worst))
        out.push_back(item(info, run, worst, check_title(group.front()), failure_text(group)));
    }
  }
  return out;
}

/// What known discrepancies are about, each once however many variants are compared with it.
struct Targets {
  std::set<std::tuple<std::string, double, int>>
      printed;  ///< reference, value, which of equal ones
  std::set<std::tuple<std::string, std::string, std::string, int>> stated;  ///< case, check, entry

  void add(const Run& run, const Check& check, const Results& results) {
    const Reference* reference = results.reference(check.reference);
    if (reference == nullptr || !check.expected) {
      stated.insert({run.case_id, check.name, check.quantity, check.index.value_or(-1)});
      return;
    }
    const bool equal = std::ranges::count(reference->values, check.expected) > 1;
    printed.insert({check.reference, *check.expected, equal ? check.index.value_or(-1) : -1});
  }
  [[nodiscard]] std::string text() const {
    std::string text;
    if (!printed.empty()) text = count(printed.size(), "printed number");
    if (!stated.empty()) text += (text.empty() ? "" : " and ") + count(stated.size(), "statement");
    return text;
  }
};

Targets targets_of(const Results& results) {
  Targets targets;
  for (const Run& run : results.runs)
    for (const Check& check : run.checks)
      if (check_status(check) == CheckStatus::known_discrepancy) targets.add(run, check, results);
  return targets;
}

/// Differences with one and the same reason.
struct Reason {
  std::string text;
  const Check* lowest;
  const Check* highest;
  std::vector<const Run*> runs;
};

/// Known discrepancies of a family under one name and with one reference.
struct KnownDiscrepancy {
  const Family* family;
  const Check* first;
  std::size_t checks = 0;
  std::vector<const CaseInfo*> cases;
  std::vector<Reason> reasons;
  Targets targets = {};
};

void add(KnownDiscrepancy& known, const Run& run, const Check& check, const CaseInfo& info) {
  ++known.checks;
  find_or_add<const CaseInfo*>(
      known.cases, [&](const CaseInfo* c) { return c == &info; }, &info);
  Reason& reason = find_or_add(
      known.reasons, [&](const Reason& r) { return r.text == check.why; },
      Reason{check.why, &check, &check, {}});
  if (check.difference < reason.lowest->difference) reason.lowest = &check;
  if (check.difference > reason.highest->difference) reason.highest = &check;
  find_or_add<const Run*>(
      reason.runs, [&](const Run* r) { return r == &run; }, &run);
}

std::vector<KnownDiscrepancy> known_discrepancies(const Results& results,
                                                  const std::vector<Family>& families) {
  std::vector<KnownDiscrepancy> out;
  for (const Family& family : families) {
    for (const Run* run : family.runs) {
      for (const Check& check : run->checks) {
        if (check_status(check) != CheckStatus::known_discrepancy) continue;
        const auto same = [&](const KnownDiscrepancy& known) {
          return known.family == &family && known.first->name == check.name &&
                 known.first->reference == check.reference && known.first->measure == check.measure;
        };
        auto& known = find_or_add(out, same, KnownDiscrepancy{&family, &check, 0, {}, {}});
        add(known, *run, check, results.case_info(run->case_id));
        known.targets.add(*run, check, results);
      }
    }
  }
  return out;
}

std::string span_text(const Check& lowest, const Check& highest) {
  if (!lowest.difference || !highest.difference) return "";
  return low_to_high(difference_text(lowest, *lowest.difference),
                     difference_text(highest, *highest.difference));
}

std::string span_text(const KnownDiscrepancy& known) {
  const Check* lowest = known.first;
  const Check* highest = known.first;
  for (const Reason& reason : known.reasons) {
    if (reason.lowest->difference < lowest->difference) lowest = reason.lowest;
    if (reason.highest->difference > highest->difference) highest = reason.highest;
  }
  return span_text(*lowest, *highest);
}

/// What does not agree: as the case puts it, else what it is compared with.
std::string known_title(const Check& check, const Reference* reference) {
  if (!check.title.empty()) return check.title;
  return reference ? reference->title : check.name;
}

std::string run_names(const Reason& reason, const KnownDiscrepancy& known, const Results& results) {
  std::string text;
  for (const Run* run : reason.runs) {
    const CaseInfo& info = results.case_info(run->case_id);
    add_item(text, info.variant_title(run->variant), "; ");
    if (known.cases.size() > 1) text += " (" + known.family->short_title(info) + ")";
  }
  return text;
}

Data reasons_data(const KnownDiscrepancy& known, const Results& results) {
  return list_of(known.reasons, [&](const Reason& reason) {
    return object({{"span", span_text(*reason.lowest, *reason.highest)},
                   {"text", reason.text},
                   {"variants", run_names(reason, known, results)}});
  });
}

/// One reason stands as it is; many stand folded, under what they come to.
Data known_data(const KnownDiscrepancy& known, const Results& results) {
  const Reference* reference = results.reference(known.first->reference);
  std::size_t variants = 0;
  for (const Reason& reason : known.reasons) variants += reason.runs.size();
  std::string extent = count(known.checks, "check");
  if (variants > 1) extent += " of " + count(variants, "variant");
  const bool single_reason = known.reasons.size() == 1;
  const auto entry = [](const CaseInfo* info) {
    return object({{"case_title", info->title}, {"case_link", case_link(info->id)}});
  };
  return object(
      {{"cases", list_of(known.cases, entry)},
       {"what", known_title(*known.first, reference)},
       {"reference_link", reference ? reference_link(reference->id) : ""},
       {"span", span_text(known)},
       {"extent", extent + " with " + known.targets.text()},
       {"reason", single_reason ? known.reasons.front().text
                                : comparison_conclusion(*known.family, results, *known.first)},
       {"reasons_title", single_reason ? "" : count(known.reasons.size(), "reason")},
       {"reasons", single_reason ? list() : reasons_data(known, results)}});
}

/// Families with known discrepancies, each with its list.
Data known_by_family(const Results& results, const std::vector<Family>& families) {
  const std::vector<KnownDiscrepancy> all = known_discrepancies(results, families);
  Data out = list();
  for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
    std::size_t checks = 0;
    Targets targets;
    Data entries = list();
    for (to = from; to < all.size() && all[to].family == all[from].family; ++to) {
      checks += all[to].checks;
      targets.printed.insert(all[to].targets.printed.begin(), all[to].targets.printed.end());
      targets.stated.insert(all[to].targets.stated.begin(), all[to].targets.stated.end());
      entries.push_back(known_data(all[to], results));
    }
    out.push_back(object({{"family_title", all[from].family->title},
                          {"extent", targets.text() + " in " + count(checks, "check")},
                          {"known", entries}}));
  }
  return out;
}

std::string verdict_text(const Counts& counts, std::size_t unexpected_endings,
                         const Targets& targets) {
  const std::size_t fails = count_of(counts, CheckStatus::fails);
  const std::size_t errors = count_of(counts, CheckStatus::error);
  if (total(counts) == 0) return "No checks were made.";
  std::string text;
  if (fails > 0) add_item(text, count(fails, "check fails", "checks fail"));
  if (errors > 0) add_item(text, std::to_string(errors) + " could not be evaluated");
  if (unexpected_endings > 0)
    add_item(text, count(unexpected_endings, "run did not end as expected",
                         "runs did not end as expected"));
  if (!text.empty()) return text + ".";
  const std::size_t known = count_of(counts, CheckStatus::known_discrepancy);
  if (count_of(counts, CheckStatus::not_given) > 0 && known == 0)
    return "Every check of what is given passes.";
  if (known == 0) return "Every check passes.";
  return "Every check with an expected agreement passes; " +
         count(known, "comparison", "comparisons") + " with " + targets.text() +
         " of the publication " + (known == 1 ? "does" : "do") + " not agree, as recorded.";
}

std::string overview_text(const Results& results, const std::vector<Family>& families,
                          const Counts& counts) {
  std::size_t cases = 0;
  for (const Family& family : families) cases += family.cases.size();
  std::string text = count(cases, "case") + " in " + count(families.size(), "family", "families") +
                     " were solved in " + count(results.runs.size(), "variant") + " and " +
                     count(total(counts), "check") + " made. ";
  if (const std::size_t known = count_of(counts, CheckStatus::known_discrepancy))
    text += count(known, "comparison does", "comparisons do") +
            " not agree; as recorded, for the reasons below. Many are one and the same target met "
            "by variant after variant: " +
            targets_of(results).text() + ". ";
  text += count(count_of(counts, CheckStatus::passes), "check passes", "checks pass") +
          " within the stated tolerance.";
  if (const std::size_t recorded = count_of(counts, CheckStatus::not_judged))
    text += " " + count(recorded, "comparison is", "comparisons are") +
            " reported without a criterion (not judged).";
  if (const std::size_t skipped = count_of(counts, CheckStatus::not_run))
    text += " " + count(skipped, "check was", "checks were") + " not run.";
  return text;
}

}  // namespace

Data summary_section(const Results& results, const std::vector<Family>& families,
                     const std::vector<SectionSummary>& summaries) {
  const Counts counts = counts_of(results, "");
  std::size_t unexpected_endings = 0;
  const Data failure_list = failures(results, unexpected_endings);
  const bool good = all_checks_pass(counts) && unexpected_endings == 0 && total(counts) > 0;
  const bool all_agree = count_of(counts, CheckStatus::known_discrepancy) == 0;
  const Data known = known_by_family(results, families);
  const auto answer = [](const SectionSummary& summary) {
    return object({{"title", summary.title}, {"anchor", summary.anchor}, {"words", summary.text}});
  };
  const auto head = [](CheckStatus which) { return with_status(which); };
  return object({{"verdict", verdict_text(counts, unexpected_endings, targets_of(results))},
                 {"verdict_class", css_class(!good       ? CheckStatus::fails
                                             : all_agree ? CheckStatus::passes
                                                         : CheckStatus::known_discrepancy)},
                 {"overview", overview_text(results, families, counts)},
                 {"bar", counts_list(counts)},
                 {"roles", role_table(results)},
                 {"has_troubles", failure_list.is_non_empty_list()},
                 {"troubles", failure_list},
                 {"has_answers", !summaries.empty()},
                 {"answers", list_of(summaries, answer)},
                 {"has_known", known.is_non_empty_list()},
                 {"known_families", known},
                 {"heads", list_of(role_columns(counts), head)}});
}

}  // namespace trammel::reports
