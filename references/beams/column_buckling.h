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

/// A cantilever under an end force P = p EI/L^2 that follows the tip's tangent (Beck), or forces q
/// EI/L^3 a length that follow the tangent all along (Leipholz); V. V. Bolotin, Nonconservative
/// Problems of the Theory of Elastic Stability, 1963, section 2.2. With x from the tip over L and
/// W = w L^2 sqrt(rho A/EI),  v'''' + (p + q x) v'' = W^2 v  by power series; where its two lowest
/// roots meet, the column flutters: p = 20.0510, q = 40.0537.
/// Arguments: output (flutter-load | frequencies | growth-rate), load (tip | spread),
/// load_parameter p or q (not for the first), EI_N_m2, length_m, mass_kg_per_m (1 each where
/// absent). Values: the load [N or N/m], the two lowest frequencies [Hz], or the rate of growth
/// [1/s].
[[nodiscard]] std::vector<double> becks_column_program(const Json& arguments);

}  // namespace trammel::references
