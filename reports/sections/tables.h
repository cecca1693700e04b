#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/text/csv.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The tables of a case: the checks themselves if they are few, else the worst of each with all of
/// them folded.
[[nodiscard]] Data case_tables(const CaseInfo& info, const std::vector<const Run*>& runs,
                               const Results& results);

/// All checks of a case with every digit.
[[nodiscard]] Table checks_table(const CaseInfo& info, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
