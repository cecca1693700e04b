#pragma once

#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Statics in large motion, at each load factor or along the whole path: geometrically exact.
[[nodiscard]] StepResult analyse_large_statics(const JsonView& analysis,
                                               const CaseModel& case_model, std::size_t step,
                                               bool draw, Recorder& record);

}  // namespace trammel::harness
