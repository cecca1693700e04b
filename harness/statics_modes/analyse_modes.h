#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Natural frequencies, at rest, under the model's loads or in a rotating frame; along a path one
/// quantity a mode, frequency_Hz:1 ... A manipulator's that nothing is joined to follow its pose
/// (solver/poses/pose_modes.h); any other's are found point by point.
[[nodiscard]] StepResult analyse_modes(const JsonView& analysis, const CaseModel& case_model,
                                       bool draw, Recorder& record);

}  // namespace trammel::harness
