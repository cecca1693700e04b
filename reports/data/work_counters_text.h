#pragma once

#include <string>

#include "reports/data/results.h"

namespace trammel::reports {

/// "192 element evaluations, 2 factorizations".
[[nodiscard]] std::string work_counters_text(const Counters& counters);

}  // namespace trammel::reports
