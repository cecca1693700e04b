#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Multiples of all loads together at which the model buckles, and what they make of each force.
[[nodiscard]] StepResult analyse_buckling(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
