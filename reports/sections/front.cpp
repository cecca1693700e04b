#include <algorithm>

#include "reports/data/check_text.h"
#include "reports/sections/sections.h"
#include "reports/text/html.h"
#include "reports/text/number.h"

namespace trammel::reports {

namespace {

/// Checks of one role; a check counts once, by its worst entry.
struct RoleCount {
  std::size_t passing = 0, all = 0;
};

RoleCount count_role(const Results& results, const std::string& role) {
  RoleCount found;
  for (const Run& run : results.runs)
    for (const CheckGroup& group : group_checks(run)) {
      if (group.front().role != role) continue;
      ++found.all;
      if (check_status(group.worst()) == CheckStatus::passes) ++found.passing;
    }
  return found;
}

Data tile(const std::string& number, const std::string& title, const std::string& words,
          const std::string& link, CheckStatus status) {
  return with_status(status,
                     {{"number", number}, {"title", title}, {"words", words}, {"link", link}});
}

Data tiles_of(const Results& results, std::size_t printed) {
  Data tiles = list();
  const RoleCount solver = count_role(results, "verification");
  tiles.push_back(tile(std::to_string(solver.passing) + " of " + std::to_string(solver.all),
                       "Solver verification",
                       "checks against exact values, other codes and theory pass.", "orders.html",
                       solver.passing == solver.all ? CheckStatus::passes : CheckStatus::fails));
  if (results.claims) {
    const auto count_of_verdict = [&](const std::string& verdict) {
      return std::ranges::count(results.claims->claims, verdict, &Claim::verdict);
    };
    tiles.push_back(
        tile(std::to_string(count_of_verdict("contradicted")) + " of " +
                 std::to_string(results.claims->claims.size()),
             "The paper's claims",
             "are contradicted; " + std::to_string(count_of_verdict("confirmed")) + " confirmed, " +
                 std::to_string(count_of_verdict("confirmed in part")) + " in part, " +
                 std::to_string(count_of_verdict("cannot be decided")) + " cannot be decided.",
             "paper.html", CheckStatus::known_discrepancy));
  }
  if (printed > 0)
    tiles.push_back(tile(std::to_string(printed), "Printed numbers that differ",
                         "from the computed ones, each with its reason.", "paper.html#known",
                         CheckStatus::known_discrepancy));
  return tiles;
}

/// The first figure of the galleries whose name ends so, as a file of its own.
const Figure* find_figure(const std::vector<Family>& families, const std::string& end) {
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases)
      for (const Figure& figure : family.galleries.at(info->id).shown)
        if (figure.id.ends_with(end)) return &figure;
  return nullptr;
}

void add_figure(const Figure* figure, const std::string& link, Data& figures) {
  if (figure == nullptr) return;
  Figure linked = *figure;
  linked.is_linked = true;
  linked.number = static_cast<int>(figures.list_value().size()) + 1;
  Data data = figure_data(linked);
  data.set("more", link);
  figures.push_back(data);
}

/// The manipulator, what the paper prints and what is computed, and the mode shapes.
Data answer_of(const std::vector<Family>& families) {
  Data figures = list();
  const Figure* agreement = find_figure(families, "-agreement");
  if (agreement == nullptr) return figures;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases) {
      const auto& shown = family.galleries.at(info->id).shown;
      if (std::ranges::find(shown, agreement->id, &Figure::id) == shown.end()) continue;
      for (const char* end : {"-mechanism", "-agreement", "-shapes"})
        for (const Figure& figure : shown)
          if (figure.id.ends_with(end)) {
            add_figure(&figure, case_link(info->id), figures);
            break;
          }
    }
  return figures;
}

/// Cost, stability and effects, a figure each.
Data questions_of(const std::vector<Family>& families, const CostPanels& panels) {
  Data figures = list();
  if (!panels.studies.empty()) add_figure(&panels.studies.front().figure, "cost.html", figures);
  for (const Family& family : families) {
    const bool is_stress = std::ranges::any_of(
        family.cases, [](const CaseInfo* info) { return info->stress_suite.has_value(); });
    if (!is_stress || family.overview.empty()) continue;
    add_figure(&family.overview.front(), "stress.html", figures);
    break;
  }
  if (!panels.effects.empty()) add_figure(&panels.effects.front(), "effects.html", figures);
  return figures;
}

}  // namespace

Data front_section(const Results& results, const std::vector<Family>& families,
                   const CostPanels& panels, std::size_t printed) {
  const Data answer = answer_of(families), questions = questions_of(families, panels);
  return object({{"tiles", tiles_of(results, printed)},
                 {"has_answer", answer.is_non_empty_list()},
                 {"answer", answer},
                 {"has_questions", questions.is_non_empty_list()},
                 {"questions", questions}});
}

}  // namespace trammel::reports
