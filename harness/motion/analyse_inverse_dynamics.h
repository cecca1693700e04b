#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Torques along the whole path, motions of all links, power balance, residuals of the properties
/// of Eq. 4, 5, work over a turn.
[[nodiscard]] StepResult analyse_inverse_dynamics(const JsonView& analysis,
                                                  const CaseModel& case_model, bool draw,
                                                  Recorder& record);

}  // namespace trammel::harness
