#pragma once

#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Relative error norms of a manufactured solution on one mesh; needs no scene.
[[nodiscard]] StepResult analyse_manufactured(const Document& document,
                                              const References& references, bool draw,
                                              Recorder& record);

}  // namespace trammel::harness
