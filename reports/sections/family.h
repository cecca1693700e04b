#pragma once

#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// A case with its tables and (drawn) figures.
[[nodiscard]] Data case_section(const CaseInfo& info, const Family& family, const Results& results);

/// A family with what its cases have in common, and a line for each of them.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// A drawn figure for its template.
[[nodiscard]] Data figure_data(const Figure& figure);

}  // namespace trammel::reports
