#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Figures of a case: shown, folded, and reasons of those that could not be drawn.
struct Gallery {
  std::vector<Figure> shown, folded;
  std::vector<std::string> problems;
};

/// A family of cases with their runs and all figures.
struct Family {
  std::string id, title;
  std::vector<const CaseInfo*> cases;
  std::vector<const Run*> runs;
  std::vector<Figure> overview;
  std::map<std::string, Gallery> galleries;  ///< by case id

  /// Returns the part of a title that distinguishes the case from the others of the family: "start
  /// of the circle" for "10 N at P, start of the circle".
  [[nodiscard]] std::string short_title(const CaseInfo& info) const;

  [[nodiscard]] std::vector<const Run*> runs_of(const std::string& case_id) const;
};

/// Returns all families with the cases that were run. Their figures are neither numbered nor drawn.
[[nodiscard]] std::vector<Family> plan_families(const Results& results);

/// Returns the figures of the page of each family and of each case.
[[nodiscard]] std::vector<std::vector<Figure*>> figures_by_page(std::vector<Family>& families);

/// Numbers the figures of each page from 1, and makes their ids unique over all pages.
void number_figures(const std::vector<std::vector<Figure*>>& pages);

}  // namespace trammel::reports
