#pragma once

#include <string>

#include "reports/data/results.h"
#include "reports/figures/gallery.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// For every validation check that many variants make against a reference: variants down, entries
/// across, nearest first. @returns a list, empty where there is none.
[[nodiscard]] Data comparison_matrices(const Family& family, const Results& results);

/// What the matrix of such a check says in a sentence or two; empty if there is none.
[[nodiscard]] std::string comparison_conclusion(const Family& family, const Results& results,
                                                const Check& check);

}  // namespace trammel::reports
