#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/sections/sections.h"

namespace trammel::reports {

struct SiteFile {
  std::string path, text;  ///< path below the folder of the report
};

/// The pages of a report: index.html, one for each family and each case, the references, and the
/// style sheets and the script that they share. Figures are drawn.
[[nodiscard]] std::vector<SiteFile> site_files(const Results& results,
                                               const std::vector<Family>& families,
                                               const CostPanels& panels,
                                               const std::optional<Figure>& over_time);

/// All of it as one page of at most 6 MB that needs no other file: without the figures of further
/// variants, the tables of every check and the drawings that do not fit, which it says.
[[nodiscard]] std::string single_page(const Results& results, std::vector<Family> families,
                                      CostPanels panels, std::optional<Figure> over_time);

}  // namespace trammel::reports
