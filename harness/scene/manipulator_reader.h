#pragma once

#include "harness/scene/case_model.h"

namespace trammel::harness {

/// Reads /model/manipulator with its pose or trajectory into the scene.
/// @throws InputError
void read_manipulator(const JsonView& model, CaseModel& case_model);

}  // namespace trammel::harness
