#pragma once

#include "harness/studies/cost_study.h"

namespace trammel::harness {

/// The refinements of a case as a study: a curve for each of the sweeps named (all when none is),
/// measured of what they name or else the checks do, against references of kind exact or computed,
/// or else against the finest level of the first one. The coarsest level of all is the baseline.
/// @throws InputError  where the case has no such sweep, or nothing can be measured.
[[nodiscard]] CostStudy cost_study_of_sweeps(const Case& given, const std::string& variant,
                                             const std::vector<std::string>& sweeps,
                                             const References& references);

}  // namespace trammel::harness
