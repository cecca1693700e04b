#pragma once

#include "harness/base/json.h"
#include "harness/scene/case_model.h"

namespace trammel::harness {

/// The rigid manipulator in plain words: bodies (mass, inertia, centre and angle at the first
/// point of the path), joints (which bodies, where then) and the path of P as a table over time.
/// @pre the scene has a manipulator
[[nodiscard]] Json mechanism_json(const CaseModel& case_model);

}  // namespace trammel::harness
