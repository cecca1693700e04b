#pragma once

#include <optional>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// A motion of one run: a few moments laid over each other, deflections magnified; a page's script
/// lets it move. Nothing where fewer than two moments are known.
[[nodiscard]] std::optional<Figure> motion_figure(const CaseInfo& info, const Run& run);

}  // namespace trammel::reports
