#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Figures of a case: the sketch of the model (at most one), figures that the page of the case
/// shows at once, and figures in a part of this page that is closed at first. Problems are the
/// reasons for figures that cannot be drawn.
struct Gallery {
  std::vector<Figure> sketch, shown, folded;
  std::vector<std::string> problems;
};

/// A family of cases, with the runs and figures of its cases.
struct Family {
  std::string id, title;
  std::string group = {};    ///< title of a group of families on the front page
  std::size_t position = 0;  ///< position of the family in the report
  std::vector<const CaseInfo*> cases = {};
  std::vector<const Run*> runs = {};
  std::vector<Figure> overview = {};
  std::map<std::string, Gallery> galleries = {};  ///< by case id

  /// Returns the words of a title that distinguish a case from other cases of its family: "start of
  /// the circle" for "10 N at P, start of the circle".
  [[nodiscard]] std::string short_title(const CaseInfo& info) const;

  [[nodiscard]] std::vector<const Run*> runs_of(const std::string& case_id) const;
};

/// Returns all families with the cases that were run. The figures are not yet drawn.
[[nodiscard]] std::vector<Family> plan_family_figures(const Results& results);

/// Returns the figures of all families and of their cases.
[[nodiscard]] std::vector<Figure*> all_figures(std::vector<Family>& families);

/// Makes the ids of all figures of a report unique.
void make_ids_unique(const std::vector<Figure*>& figures);

}  // namespace trammel::reports
