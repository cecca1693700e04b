#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"

namespace trammel::reports {

/// Share of the tolerance that every check of a family uses which is expected to agree.
/// @param titles  of the cases, by id.
[[nodiscard]] std::optional<Figure> tolerance_figure(
    const std::string& family, const std::map<std::string, std::string>& titles,
    const std::vector<const Run*>& runs);

}  // namespace trammel::reports
