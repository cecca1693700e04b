#pragma once

#include "harness/scene/case_model.h"
#include "solver/manipulator/elastodynamics.h"

namespace trammel::harness {

/// The options that the analysis itself states, whatever the scene and its effects.
[[nodiscard]] solver::ElastodynamicsOptions read_motion_options(const JsonView& analysis);

/// The motion that a case of elastodynamics describes, with the scene's effects.
/// @throws InputError  where something stands beside the manipulator or the trajectory has no time.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics(const JsonView& analysis,
                                                                const CaseModel& case_model);

}  // namespace trammel::harness
