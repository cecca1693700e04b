#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Motion in time of a geometrically exact model: one number an output time.
[[nodiscard]] StepResult analyse_large_motion(const JsonView& analysis, const CaseModel& case_model,
                                              bool draw, Recorder& record);

}  // namespace trammel::harness
