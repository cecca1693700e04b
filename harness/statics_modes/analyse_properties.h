#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Lengths, masses, centres and inertias of the parts and of the whole.
[[nodiscard]] StepResult analyse_properties(const JsonView& analysis, const CaseModel& case_model,
                                            std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
