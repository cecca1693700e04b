#pragma once

#include <set>
#include <vector>

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Amplitudes of the outputs over frequency, and their peaks.
[[nodiscard]] StepResult analyse_harmonic(const JsonView& analysis, const CaseModel& case_model,
                                          std::size_t step, bool draw, Recorder& record);

/// Of the frequencies that it goes through, numbered from 0: every fourth, the last, and those on
/// both sides of each natural frequency, so that no peak lies between them.
[[nodiscard]] std::set<std::size_t> harmonic_sample(const JsonView& analysis,
                                                    const CaseModel& case_model);

/// The amplitudes at some of them alone, without the peaks.
[[nodiscard]] StepResult analyse_harmonic_at(const JsonView& analysis, const CaseModel& case_model,
                                             const std::vector<std::size_t>& points,
                                             Recorder& record);

}  // namespace trammel::harness
