#pragma once

#include <optional>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Up to eight shapes of one run as small multiples: undeformed grey, deformed coloured.
[[nodiscard]] std::optional<Figure> shapes_figure(const CaseInfo& info, const Run& run);

}  // namespace trammel::reports
