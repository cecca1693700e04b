#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Derivatives of the natural frequencies with respect to the design, at one pose.
[[nodiscard]] StepResult analyse_sensitivity(const JsonView& analysis, const CaseModel& case_model,
                                             bool draw, Recorder& record);

}  // namespace trammel::harness
