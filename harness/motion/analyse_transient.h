#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// The outputs over time, and their peaks.
[[nodiscard]] StepResult analyse_transient(const JsonView& analysis, const CaseModel& case_model,
                                           std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
