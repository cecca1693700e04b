#pragma once

#include <string>
#include <vector>

#include "reports/sections/sections.h"

namespace trammel::reports {

struct SiteFile {
  std::string path, text;  ///< path relative to the report folder, content
};

/// Returns the pages of a report with drawn figures, and the style sheets and scripts that the
/// pages share: index.html, the pages of sections, one page for each family and case, and the
/// references.
[[nodiscard]] std::vector<SiteFile> site_files(const Results& results,
                                               const std::vector<Family>& families,
                                               const StudyFigures& figures);

}  // namespace trammel::reports
