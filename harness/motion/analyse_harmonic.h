#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Amplitudes of the outputs over frequency, and their peaks.
[[nodiscard]] StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

/// How many frequencies it goes through.
[[nodiscard]] std::size_t harmonic_points(const JsonView& analysis);

/// The amplitudes at some of them alone, without the peaks.
[[nodiscard]] StepResult analyse_harmonic_at(const JsonView& analysis, const CaseModel& case_model,
                                             const std::vector<std::size_t>& points,
                                             Recorder& record);

}  // namespace trammel::harness
