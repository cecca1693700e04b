#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// How the exact natural frequencies of a frame change with its numbers.
namespace trammel::references {

/// Central differences of `frame_frequencies`, each good to 1e-20, at step, step / 2 and step / 4,
/// extrapolated twice: the error is O(step^6) beside 1e-20 over the step. Of frequencies that stay
/// repeated, the common derivative.
/// Arguments: model (or manipulator and pose), pointers (JSON pointers into the arguments, to equal
/// numbers that change together), step (in their unit), count. Values: [Hz / unit], ascending in
/// frequency.
[[nodiscard]] std::vector<double> frame_sensitivity_program(const Json& arguments);

}  // namespace trammel::references
