#pragma once

#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Every combination of some options tried on the variants and levels of other cases: how they end,
/// how many numbers are none, how many reasons lack words, how far apart are those that must agree.
[[nodiscard]] StepResult analyse_options(const Document& document, const References& references,
                                         bool draw, Recorder& record);

}  // namespace trammel::harness
