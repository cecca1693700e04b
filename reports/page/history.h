#pragma once

#include <optional>

#include "reports/data/results.h"
#include "reports/drawing/figure.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// What changed over the calls that a history keeps.
/// @param figure  drawn
[[nodiscard]] Data history_section(const Results& results, const std::optional<Figure>& figure);

}  // namespace trammel::reports
