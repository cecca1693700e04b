#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Joint angles, closure, distances from singularities, holding torques of a manipulator.
[[nodiscard]] StepResult analyse_kinematics(const JsonView& analysis, const CaseModel& case_model,
                                            std::size_t step, bool draw, Recorder& record);

}  // namespace trammel::harness
