#pragma once

#include "solver/model/model.h"

namespace trammel::solver {

/// Checks what `assemble` relies on: indices inside their ranges, finite positions, positive
/// lengths, areas and stiffnesses.
/// @throws ModelError  one sentence that names the part and what is wrong with it.
void validate(const Model& model);

}  // namespace trammel::solver
