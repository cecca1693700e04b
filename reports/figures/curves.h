#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// @returns nullptr where no run is of this variant.
[[nodiscard]] const Run* find_run(const std::vector<const Run*>& runs, const std::string& variant);

/// What a case's "figures" entry asks for. @param problem  set to the reason where it cannot be
/// drawn (a quantity or variant that is not there, lengths that differ).
[[nodiscard]] std::optional<Figure> curves_figure(const CaseInfo& info, const PlotRequest& request,
                                                  const std::vector<const Run*>& runs,
                                                  std::string& problem);

}  // namespace trammel::reports
