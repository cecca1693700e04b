#pragma once

#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Another analysis at each value of a parameter: every quantity kept has one number a value.
[[nodiscard]] StepResult analyse_study(const Document& document, const References& references,
                                       bool draw, Recorder& record);

/// The levels of a study, each with the inner analysis in the study's place.
[[nodiscard]] std::vector<Level> study_levels(const Document& document);

}  // namespace trammel::harness
