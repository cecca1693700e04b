#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Amplitudes of the outputs over frequency, and their peaks.
[[nodiscard]] StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
