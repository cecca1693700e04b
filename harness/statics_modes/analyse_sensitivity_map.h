#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// The first elastic frequency and its derivative over the workspace, for some orientations.
[[nodiscard]] StepResult analyse_sensitivity_map(const JsonView& analysis,
                                                 const CaseModel& case_model, bool draw,
                                                 Recorder& record);

}  // namespace trammel::harness
