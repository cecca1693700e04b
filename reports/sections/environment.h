#pragma once

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// Machine, compiler, libraries.
[[nodiscard]] Data environment_section(const Results& results);

}  // namespace trammel::reports
