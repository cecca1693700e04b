#pragma once

#include "harness/analysis_kinds.h"
#include "solver/system.h"

namespace trammel {

/// Modes in a steadily rotating frame, key "rotating" of the modes: at one speed, or one number a
/// speed. Not solved: the first speed without a steady state.
[[nodiscard]] StepResult analyse_rotating(const Cursor& modes, const System& system, bool draw,
                                          Recorder& record);

}  // namespace trammel
