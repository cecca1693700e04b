#pragma once

#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// One family with its cases, tables and (drawn) figures.
[[nodiscard]] Data family_section(const Family& family, const Results& results);

/// A drawn figure for its template.
[[nodiscard]] Data figure_data(const Figure& figure);

}  // namespace trammel::reports
