#pragma once

#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// What a section of the page comes to, in a sentence.
struct SectionSummary {
  std::string title, anchor, text;
};

/// What passes, what fails, the summaries of the sections, what does not agree and why.
[[nodiscard]] Data summary_section(const Results& results, const std::vector<Family>& families,
                                   const std::vector<SectionSummary>& summaries);

}  // namespace trammel::reports
