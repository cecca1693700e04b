#pragma once

#include "solver/manipulator/manipulator.h"
#include "solver/model/effects.h"

namespace trammel::solver {

/// The manipulator without the effects that are not in `active`, before a model is built of it.
[[nodiscard]] ManipulatorDesign restrict_effects(ManipulatorDesign design, Effects active);

}  // namespace trammel::solver
