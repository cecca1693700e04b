#pragma once

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// What is verified by what kind of evidence, and what by none.
/// @param with_verified  features with independent evidence, too
[[nodiscard]] Data coverage_section(const Results& results, bool with_verified);

}  // namespace trammel::reports
