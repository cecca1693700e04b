#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

#include "harness/base/find_or_add.h"
#include "reports/sections/sections.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Roles of checks with their meanings. The last table row is the sum of all roles.
constexpr std::array<std::pair<const char*, const char*>, 4> kRoles = {{
    {"verification", "against exact or independent reference solutions"},
    {"validation", "against the published results"},
    {"regression", "against earlier results of this solver"},
    {"all", ""},
}};

/// Returns the number of checks with each status, for the checks with one role.
/// @param role  "all" for the checks of all roles
Counts counts_of(const Results& results, const std::string& role) {
  Counts counts;
  for (const Run& run : results.runs)
    for (const CheckGroup& group : group_checks(run))
      if (role == "all" || group.front().role == role) ++counts[find_status(group.worst())];
  return counts;
}

/// Sets the table of the number of checks by role and status. Statuses without a check are omitted,
/// except for "fails".
void set_table_of_roles(Data& data, const Results& results, const Counts& all) {
  Data heads = list(), rows = list();
  std::vector<CheckStatus> columns;
  for (const StatusStyle& style : kStatusStyles) {
    if (style.status != CheckStatus::fails && count_of(all, style.status) == 0) continue;
    columns.push_back(style.status);
    heads.push_back(status_data(style.status));
  }
  for (const auto& [role, meaning] : kRoles) {
    const Counts counts = counts_of(results, role);
    if (counts.empty() && std::string(role) != "all") continue;
    const auto cell = [&](CheckStatus status) {
      const std::size_t n = count_of(counts, status);
      return status_data(status, {{"n", n ? std::to_string(n) : ""}});
    };
    rows.push_back(object({{"role", role},
                           {"meaning", meaning},
                           {"cells", list_of(columns, cell)},
                           {"total", std::to_string(total(counts))}}));
  }
  set(data, {{"heads", heads}, {"roles", rows}});
}

/// Returns the runs whose status is not the expected one, and the checks that fail or could not be
/// judged.
Data list_failures(const Results& results, std::size_t& unexpected_endings) {
  Data out = list();
  for (const Run& run : results.runs) {
    const CaseInfo& info = results.case_info(run.case_id);
    const std::string variant = info.variants.size() > 1 ? info.variant_title(run.variant) : "";
    const auto add = [&](CheckStatus status, const std::string& what, const std::string& text) {
      if (is_failure(status))
        out.push_back(status_data(status, {{"case_title", info.title},
                                           {"case_link", case_link(info.id)},
                                           {"variant_title", variant},
                                           {"what", what},
                                           {"text", text}}));
    };
    if (is_failure(find_status(run))) ++unexpected_endings;
    add(find_status(run), to_string(run.status), run.reason);
    for (const CheckGroup& group : group_checks(run))
      add(find_status(group.worst()), check_title(group.front()), failure_text(group));
  }
  return out;
}

/// Published numbers and statements with a known discrepancy. A number counts once, even if several
/// variants are compared with it.
struct Targets {
  std::set<std::tuple<std::string, double, int>> printed;  ///< reference, value, index if repeated
  std::set<std::tuple<std::string, std::string, std::string, int>> stated;  ///< case, check, index

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

Targets targets_of_results(const Results& results) {
  Targets targets;
  for (const Run& run : results.runs)
    for (const Check& check : run.checks)
      if (find_status(check) == CheckStatus::known_discrepancy) targets.add(run, check, results);
  return targets;
}

std::string known_checks_text(const Results& results) {
  return count(count_of(counts_of(results, "all"), CheckStatus::known_discrepancy), "check");
}

/// Known discrepancies of all values of one check in all variants of a case.
struct KnownDiscrepancy {
  const CaseInfo* info;
  std::vector<std::pair<const Run*, const Check*>> entries;  ///< largest difference first

  [[nodiscard]] const Check& largest() const { return *entries.front().second; }
};

std::vector<KnownDiscrepancy> known_discrepancies(const Family& family, const Results& results) {
  std::vector<KnownDiscrepancy> known;
  for (const Run* run : family.runs)
    for (const Check& check : run->checks) {
      if (find_status(check) != CheckStatus::known_discrepancy) continue;
      const CaseInfo& info = results.case_info(run->case_id);
      const auto same = [&](const KnownDiscrepancy& other) {
        return other.info == &info && other.largest().name == check.name;
      };
      auto& entries = harness::find_or_add(known, same, {&info, {}}).entries;
      entries.emplace_back(run, &check);
      if (is_worse_than(check, *entries.front().second)) std::swap(entries.front(), entries.back());
    }
  return known;
}

Data known_data(const KnownDiscrepancy& known, const std::string& title, const Results& results) {
  const Check& check = known.largest();
  const Reference* reference = results.reference(check.reference);
  std::set<std::string> reasons;
  for (const auto& entry : known.entries) reasons.insert(entry.second->why);
  return object(
      {{"case_title", title},
       {"case_link", case_link(known.info->id)},
       {"what", check.title.empty() && reference ? reference->title : check_title(check)},
       {"reference_link", reference ? reference_link(reference->id) : ""},
       {"difference", check.difference ? difference_text(check, *check.difference) : ""},
       {"uncertainty", uncertainty_text(*known.entries.front().first, check)},
       {"extent", count(known.entries.size(), "entry", "entries")},
       {"reason", check.why},
       {"further_reasons",
        reasons.size() > 1 ? count(reasons.size() - 1, "further reason") + " on its page" : ""}});
}

/// Returns the families that have known discrepancies, each with a list of its discrepancies.
Data known_discrepancies_by_family(const Results& results, const std::vector<Family>& families) {
  Data out = list();
  for (const Family& family : families) {
    const std::vector<KnownDiscrepancy> known = known_discrepancies(family, results);
    if (known.empty()) continue;
    Targets targets;
    std::size_t entries = 0;
    for (const KnownDiscrepancy& discrepancy : known) {
      entries += discrepancy.entries.size();
      for (const auto& [run, check] : discrepancy.entries) targets.add(*run, *check, results);
    }
    const auto entry = [&](const KnownDiscrepancy& discrepancy) {
      return known_data(discrepancy, family.short_title(*discrepancy.info), results);
    };
    out.push_back(object({{"family_title", family.title},
                          {"extent", targets.text() + " in " + count(entries, "entry", "entries")},
                          {"known", list_of(known, entry)}}));
  }
  return out;
}

/// Returns the most frequent reasons of known discrepancies with their numbers of values, and the
/// number of values with other reasons.
Data reasons_of_discrepancies(const std::vector<KnownDiscrepancy>& known) {
  constexpr std::ptrdiff_t kShown = 4;
  std::map<std::string, std::size_t> entries;
  for (const KnownDiscrepancy& discrepancy : known)
    for (const auto& entry : discrepancy.entries) ++entries[entry.second->why];
  std::vector<std::pair<std::string, std::size_t>> sorted(entries.begin(), entries.end());
  std::ranges::stable_sort(sorted, std::greater(), &std::pair<std::string, std::size_t>::second);
  std::size_t others = 0;
  for (; std::ssize(sorted) > kShown; sorted.pop_back()) others += sorted.back().second;
  if (others > 0) sorted.emplace_back("other reasons", others);
  return list_of(sorted, [](const auto& reason) {
    return object({{"reason", reason.first}, {"n", std::to_string(reason.second)}});
  });
}

std::string verdict_text(const Counts& counts, std::size_t unexpected_endings) {
  if (total(counts) == 0) return "No checks were made; there is nothing to compare with.";
  std::string text;
  const auto add = [&](std::size_t n, const std::string& one, const std::string& many) {
    if (n > 0) add_item(text, count(n, one, many));
  };
  add(count_of(counts, CheckStatus::fails), "check fails", "checks fail");
  add(count_of(counts, CheckStatus::changed_discrepancy), "known discrepancy has changed",
      "known discrepancies have changed");
  add(count_of(counts, CheckStatus::error), "check could not be evaluated",
      "checks could not be evaluated");
  add(unexpected_endings, "run did not end as expected", "runs did not end as expected");
  if (!text.empty()) return text + ".";
  if (count_of(counts, CheckStatus::known_discrepancy) == 0) return "Every check passes.";
  return "Every check passes, or differs from the publication as recorded.";
}

std::string overview_text(const Results& results, const std::vector<Family>& families,
                          const Counts& counts) {
  std::size_t cases = 0, numbers = 0;
  for (const Family& family : families) cases += family.cases.size();
  for (const Run& run : results.runs) numbers += run.checks.size();
  return count(cases, "case") + " in " + count(families.size(), "family", "families") + ", " +
         count(results.runs.size(), "run") + ", " + count(total(counts), "check") + " of " +
         count(numbers, "number") + ":";
}

Data tile(const std::string& number, const std::string& title, const std::string& words,
          const std::string& link, CheckStatus status) {
  return status_data(status,
                     {{"number", number}, {"title", title}, {"words", words}, {"link", link}});
}

Data key_number_tiles(const Results& results) {
  Data tiles = list();
  const Counts solver = counts_of(results, "verification");
  const std::size_t passing = count_of(solver, CheckStatus::passes);
  if (total(solver) > 0)
    tiles.push_back(tile(std::to_string(passing) + " of " + std::to_string(total(solver)),
                         results.claims ? "Solver verification" : "Verification",
                         "checks against exact values, other codes and theory pass.",
                         results.claims ? "orders.html" : "index.html#trust",
                         passing == total(solver) ? CheckStatus::passes : CheckStatus::fails));
  if (results.claims) {
    const auto count_of = [&](const std::string& verdict) {
      return std::to_string(std::ranges::count(results.claims->claims, verdict, &Claim::verdict));
    };
    tiles.push_back(
        tile(count_of("contradicted") + " of " + std::to_string(results.claims->claims.size()),
             "The paper's claims",
             "are contradicted; " + count_of("confirmed") + " confirmed, " +
                 count_of("confirmed in part") + " in part, " + count_of("cannot be decided") +
                 " cannot be decided.",
             "paper.html", CheckStatus::known_discrepancy));
  }
  const Targets targets = targets_of_results(results);
  if (!targets.printed.empty())
    tiles.push_back(tile(std::to_string(targets.printed.size()), "Printed numbers that differ",
                         "from the computed ones; " + known_checks_text(results) + " compare " +
                             targets.text() + ".",
                         "paper.html#known", CheckStatus::known_discrepancy));
  return tiles;
}

void add_figure(const Figure& figure, const std::string& link, Data& figures) {
  Figure linked = figure;
  linked.is_linked = true;
  Data data = figure_data(linked);
  set(data, {{"more", link}, {"is_agreement", figure.id.ends_with("-agreement")}});
  figures.push_back(data);
}

/// Returns the figures of the case with the largest number of comparisons of printed and computed
/// values: the manipulator, its frequencies and its modes. Only cases with validation uncertainties
/// are considered.
Data manipulator_figures(const std::vector<Family>& families) {
  const Gallery* found = nullptr;
  std::size_t most = 0;
  for (const Family& family : families)
    for (const auto& [id, gallery] : family.galleries) {
      if (!family.runs_of(id).front()->uncertainty) continue;
      for (const Figure& figure : gallery.shown) {
        if (!figure.id.ends_with("-agreement") || figure.data.rows.size() <= most) continue;
        most = figure.data.rows.size();
        found = &gallery;
      }
    }
  Data figures = list();
  if (found == nullptr) return figures;
  for (const std::vector<Figure>* part : {&found->sketch, &found->shown})
    for (const Figure& figure : *part) add_figure(figure, "", figures);
  return figures;
}

/// Returns one figure each of computing cost, of numerical stability and of the selected effects.
Data study_figures(const StudyFigures& studies) {
  Data figures = list();
  const auto modes = std::ranges::find(studies.cost, kLeadFigure, &Figure::id);
  if (modes != studies.cost.end()) add_figure(*modes, "cost.html", figures);
  if (!studies.stress.empty()) add_figure(studies.stress.front(), "stress.html", figures);
  if (!studies.effects.empty()) add_figure(studies.effects.front(), "effects.html", figures);
  return figures;
}

}  // namespace

std::string uncertainty_text(const Run& run, const Check& check) {
  const Comparison* found = find_comparison(run, check);
  if (!found || !check.expected) return "";
  return "± " + percent_text(2 * *found->u_val / std::abs(*check.expected), 2, false);
}

Data discrepancy_section(const Results& results, const std::vector<Family>& families) {
  const Data known = known_discrepancies_by_family(results, families);
  return object({{"has_rows", known.is_non_empty_list()},
                 {"words", targets_of_results(results).text()},
                 {"checks", known_checks_text(results)},
                 {"known_families", known}});
}

Data audit_section(const Results& results, const std::vector<Family>& families,
                   const Data& summary) {
  constexpr std::ptrdiff_t kShown = 10;
  std::vector<KnownDiscrepancy> known;
  for (const Family& family : families)
    std::ranges::copy(known_discrepancies(family, results), std::back_inserter(known));
  std::ranges::stable_sort(known, std::greater(), [](const KnownDiscrepancy& discrepancy) {
    const Check& largest = discrepancy.largest();
    return largest.measure == "relative" ? size_of_difference(largest) : 0;
  });
  const auto rest = known.begin() + std::min(kShown, std::ssize(known));
  const auto row = [&](const KnownDiscrepancy& discrepancy) {
    return known_data(discrepancy, discrepancy.info->title, results);
  };
  return object({{"summary", summary},
                 {"has_known", !known.empty()},
                 {"largest", list_of(std::vector(known.begin(), rest), row)},
                 {"rest", reasons_of_discrepancies({rest, known.end()})}});
}

Data summary_section(const Results& results, const std::vector<Family>& families) {
  const Counts counts = counts_of(results, "all");
  std::size_t unexpected_endings = 0;
  const Data failure_list = list_failures(results, unexpected_endings);
  CheckStatus status = total(counts) > 0 ? CheckStatus::passes : CheckStatus::not_judged;
  if (count_of(counts, CheckStatus::known_discrepancy) > 0) status = CheckStatus::known_discrepancy;
  if (!all_checks_pass(counts) || unexpected_endings > 0) status = CheckStatus::fails;
  Data data = object({{"verdict", verdict_text(counts, unexpected_endings)},
                      {"verdict_class", find_style(status).css_class},
                      {"overview", overview_text(results, families, counts)},
                      {"bar", data_of_status_counts(counts)},
                      {"has_troubles", failure_list.is_non_empty_list()},
                      {"troubles", failure_list}});
  set_table_of_roles(data, results, counts);
  return data;
}

Data front_page_section(const Results& results, const std::vector<Family>& families,
                        const StudyFigures& studies) {
  const Data answer = manipulator_figures(families), questions = study_figures(studies);
  Data trust = list();
  for (const Figure& figure : studies.trust) add_figure(figure, "orders.html", trust);
  return object({{"tiles", key_number_tiles(results)},
                 {"trust", trust},
                 {"has_answer", answer.is_non_empty_list()},
                 {"answer", answer},
                 {"has_questions", questions.is_non_empty_list()},
                 {"questions", questions}});
}

}  // namespace trammel::reports
