#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// The undeformed mechanism with its joints; the geometries of `further` runs (a title each) and
/// the drawing's own further poses are laid under it.
[[nodiscard]] std::optional<Figure> mechanism_figure(
    const CaseInfo& info, const Run& run,
    const std::vector<std::pair<std::string, const Drawing*>>& further);

}  // namespace trammel::reports
