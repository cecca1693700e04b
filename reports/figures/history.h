#pragma once

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Processor time and counted work over the calls, relative to the first that has them; calls with
/// failures are marked.
[[nodiscard]] Figure history_figure(const History& history);

}  // namespace trammel::reports
