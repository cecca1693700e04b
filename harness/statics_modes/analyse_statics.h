#pragma once

#include "harness/statics_modes/step_result.h"
#include "solver/linear/statics.h"

namespace trammel::harness {

/// Displacements, end rotations, reactions, section forces, stresses, residuals.
[[nodiscard]] StepResult analyse_statics(const JsonView& analysis, const CaseModel& case_model,
                                         std::size_t step, bool draw, Recorder& record);

/// Adds what a solution says of nodes, members, supports and plates.
/// @param roundoff  relative; negative: not known
void record_solution(const solver::Model& model, const solver::StaticSolution& solution,
                     double roundoff, Recorder& record);

}  // namespace trammel::harness
