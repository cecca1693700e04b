#pragma once

#include <vector>

#include "references/numerics/arguments.h"

/// Elastic buckling of one uniform column (S. P. Timoshenko, J. M. Gere, Theory of Elastic
/// Stability, 2nd ed., chapter 2). End loads P = x^2 EI/L^2 with
///   clamped-free cos x = 0, pinned-pinned sin x = 0, clamped-pinned tan x = x,
///   clamped-clamped sin(x/2) (tan(x/2) - x/2) = 0;
/// own weight q L = (9/4) j^2 EI/L^2, clamped-free, J_{-1/3}(j) = 0.
namespace trammel::references {

/// Arguments: ends, load (end | self-weight), count; EI_N_m2, length_m, weight_N_per_m (1 each
/// where absent). Values: critical end loads [N], or the critical multiple of the weight.
[[nodiscard]] std::vector<double> column_buckling_program(const Json& arguments);

}  // namespace trammel::references
