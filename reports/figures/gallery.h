#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// The figures of a case: those shown, those folded away, and what could not be drawn.
struct Gallery {
  std::vector<Figure> shown, folded;
  std::vector<std::string> problems;
};

/// A family as the page shows it: its cases in order, each with its runs, and all its figures.
struct Family {
  std::string id, title;
  std::vector<const CaseInfo*> cases;
  std::vector<const Run*> runs;
  std::vector<Figure> overview;
  std::map<std::string, Gallery> galleries;  ///< by case id

  /// What tells a case's title from the others of the family: "..., start of the circle" and
  /// "..., platform centred" are "start of the circle" and "platform centred".
  [[nodiscard]] std::string short_title(const CaseInfo& info) const;

  [[nodiscard]] std::vector<const Run*> runs_of(const std::string& case_id) const;
};

/// All families in the order of their first case; figures planned, neither numbered nor drawn.
/// Cases that were not run are left out.
[[nodiscard]] std::vector<Family> plan_families(const Results& results);

/// The figures of each page of the families: what the cases of a family have in common, and each
/// case.
[[nodiscard]] std::vector<std::vector<Figure*>> figures_by_page(std::vector<Family>& families);

/// Numbers the figures of each page from 1 and makes their names unique over all of them.
void number_figures(const std::vector<std::vector<Figure*>>& pages);

}  // namespace trammel::reports
