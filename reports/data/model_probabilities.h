#pragma once

#include <vector>

#include "reports/data/results.h"
#include "reports/text/html.h"

namespace trammel::reports {

/// For each row of printed numbers and each discrepancy: the most probable classes of readings with
/// what they predict, and what one further number would tell. Nothing where no run has them.
void set_model_probabilities(Data& data, const std::vector<const Run*>& runs);

}  // namespace trammel::reports
