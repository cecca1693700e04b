#pragma once

#include "solver/manipulator/manipulator.h"
#include "solver/model/effects.h"

namespace trammel {

/// The manipulator without the effects that are not in `kept`, before a model is built of it.
[[nodiscard]] ManipulatorDesign reduced(ManipulatorDesign design, Effects kept);

}  // namespace trammel
