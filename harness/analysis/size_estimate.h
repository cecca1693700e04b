#pragma once

#include <string>

#include "harness/base/processes.h"
#include "harness/input/document.h"

namespace trammel::harness {

/// Upper estimates of memory, unknowns and non-zeros of one computation, from the case file only.
struct SizeEstimate {
  double coordinates = 0;  ///< number of coordinates of the model before constraints
  /// Number of non-zeros of the factor of the stiffness matrix, in a fill-reducing order.
  double non_zeros = 0;
  double bytes = 0;   ///< memory of the entire computation
  std::string cause;  ///< JSON pointer of the key that causes the most memory
};

/// Estimates memory and non-zeros from the numbers of coordinates, modes, samples, points of paths
/// and cells of grids. A dense eigensolver and modal superposition require memory proportional to
/// the square of the number of coordinates. The factor of a frame's stiffness matrix has 12
/// non-zeros per coordinate. The factor of a plane mesh of n coordinates has 16 log2(n) non-zeros
/// per coordinate, by nested dissection (George 1973).
[[nodiscard]] SizeEstimate estimate_problem_size(const Document& document);

/// Rejects a computation that requires too much memory.
/// @throws InputError  at the key that causes the most memory, if the estimate exceeds `max_memory`
///     or a matrix factor has more non-zeros than a 32-bit integer can count.
void require_sufficient_memory(const Document& document,
                               double max_memory = static_cast<double>(memory_limit_bytes()));

}  // namespace trammel::harness
