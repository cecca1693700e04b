#pragma once

#include "harness/statics_modes/step_result.h"
#include "solver/manipulator/elastodynamics.h"

namespace trammel::harness {

/// Elastic vibration about the nominal motion along the path: deflection and error of P, joint
/// rotations, section forces, stresses, reactions, torques beside those of rigid links, energies.
[[nodiscard]] StepResult analyse_elastodynamics(const JsonView& analysis,
                                                const CaseModel& case_model, bool draw,
                                                Recorder& record);

/// What the analysis's own words say of a motion, whatever the scene and its effects.
[[nodiscard]] solver::ElastodynamicsOptions read_motion_options(const JsonView& analysis);

/// The motion that a case of elastodynamics describes, with the scene's effects.
/// @throws InputError  where something stands beside the manipulator or the trajectory has no time.
[[nodiscard]] solver::ElastodynamicsOptions read_elastodynamics(const JsonView& analysis,
                                                                const CaseModel& case_model);

}  // namespace trammel::harness
