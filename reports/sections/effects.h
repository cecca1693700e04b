#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// The effects of the first run that chose its own: a row each, and a title that names those on.
/// Nothing where no run did.
void set_effects(Data& data, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
