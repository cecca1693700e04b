#pragma once

#include <vector>

#include "references/numerics/arguments.h"

namespace trammel::references {

/// Another program at each of several values, one after the other: the true values of a parameter
/// study. Arguments: program, arguments, pointers (JSON pointers into the arguments) and values, or
/// patches (merge patches of the arguments).
/// @throws DerivationError  where a pointer leads nowhere.
[[nodiscard]] std::vector<double> parameter_sweep_program(const Json& arguments);

}  // namespace trammel::references
