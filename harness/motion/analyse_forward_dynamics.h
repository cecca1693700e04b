#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// From torques back to the motion: those of the inverse dynamics of the path, or constant ones.
[[nodiscard]] StepResult analyse_forward_dynamics(const JsonView& analysis,
                                                  const CaseModel& case_model, bool draw,
                                                  Recorder& record);

}  // namespace trammel::harness
