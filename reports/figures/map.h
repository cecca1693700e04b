#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// What an entry of a case's "figures" with a "value" asks for: a quantity in classes of colour
/// over positions, one variant, with lines on it.
[[nodiscard]] std::optional<Figure> map_figure(const CaseInfo& info, const PlotRequest& request,
                                               const std::vector<const Run*>& runs,
                                               std::string& problem);

}  // namespace trammel::reports
