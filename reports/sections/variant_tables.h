#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The tables that a case asks for: variants down, quantities and timings across.
[[nodiscard]] Data variant_tables(const CaseInfo& info, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
