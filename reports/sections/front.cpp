#include <algorithm>

#include "reports/sections/sections.h"

namespace trammel::reports {

namespace {

/// Checks of one role. A check counts once, by its worst entry.
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

Data tiles_of(const Results& results) {
  Data tiles = list();
  const RoleCount solver = count_role(results, "verification");
  tiles.push_back(tile(std::to_string(solver.passing) + " of " + std::to_string(solver.all),
                       "Solver verification",
                       "checks against exact values, other codes and theory pass.",
                       results.claims ? "orders.html" : "index.html#trust",
                       solver.passing == solver.all ? CheckStatus::passes : CheckStatus::fails));
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
  if (const std::size_t printed = count_printed(results))
    tiles.push_back(tile(std::to_string(printed), "Printed numbers that differ",
                         "from the computed ones, each with its reason.", "paper.html#known",
                         CheckStatus::known_discrepancy));
  return tiles;
}

/// Returns the case that compares most printed numbers with computed ones and their validation
/// uncertainty, and its figures.
std::pair<const CaseInfo*, const Gallery*> find_answer(const std::vector<Family>& families) {
  std::pair<const CaseInfo*, const Gallery*> found{nullptr, nullptr};
  std::size_t most = 0;
  for (const Family& family : families)
    for (const CaseInfo* info : family.cases) {
      const Gallery& gallery = family.galleries.at(info->id);
      if (!family.runs_of(info->id).front()->uncertainty) continue;
      for (const Figure& figure : gallery.shown) {
        if (!figure.id.ends_with("-agreement") || figure.data.rows.size() <= most) continue;
        most = figure.data.rows.size();
        found = {info, &gallery};
      }
    }
  return found;
}

void add_figure(const Figure& figure, const std::string& link, Data& figures) {
  Figure linked = figure;
  linked.is_linked = true;
  linked.number = static_cast<int>(figures.list_value().size()) + 1;
  Data data = figure_data(linked);
  data.set("more", link);
  figures.push_back(data);
}

/// Returns figures of the manipulator, of its printed and computed frequencies, and of its modes.
Data answer_of(const std::vector<Family>& families) {
  Data figures = list();
  const auto [info, gallery] = find_answer(families);
  if (info == nullptr) return figures;
  for (const char* end : {"-mechanism", "-agreement", "-shapes"}) {
    const auto figure = std::ranges::find_if(
        gallery->shown, [&](const Figure& shown) { return shown.id.ends_with(end); });
    if (figure != gallery->shown.end()) add_figure(*figure, case_link(info->id), figures);
  }
  return figures;
}

/// Returns a figure each of cost, stability and effects.
Data questions_of(const std::vector<Family>& families, const StudyFigures& studies) {
  Data figures = list();
  const auto modes = std::ranges::find(studies.cost, "cost-modes-elements", &Figure::id);
  if (modes != studies.cost.end()) add_figure(*modes, "cost.html", figures);
  const auto stress_cases = [](const Family& family) {
    return std::ranges::count_if(
        family.cases, [](const CaseInfo* info) { return info->stress_suite.has_value(); });
  };
  const auto stress = std::ranges::max_element(families, {}, stress_cases);
  if (stress != families.end() && stress_cases(*stress) > 0 && !stress->overview.empty())
    add_figure(stress->overview.front(), "stress.html", figures);
  if (!studies.effects.empty()) add_figure(studies.effects.front(), "effects.html", figures);
  return figures;
}

}  // namespace

Data front_section(const Results& results, const std::vector<Family>& families,
                   const StudyFigures& studies) {
  const Data answer = answer_of(families), questions = questions_of(families, studies);
  return object({{"tiles", tiles_of(results)},
                 {"has_answer", answer.is_non_empty_list()},
                 {"answer", answer},
                 {"has_questions", questions.is_non_empty_list()},
                 {"questions", questions}});
}

}  // namespace trammel::reports
