#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Natural frequencies, at rest, under the model's loads or in a rotating frame; along a path one
/// quantity a mode, frequency_Hz:1 ...
[[nodiscard]] StepResult analyse_modes(const JsonView& analysis, const CaseModel& case_model,
                                       std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
