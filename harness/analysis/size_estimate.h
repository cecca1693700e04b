#pragma once

#include <string>

#include "harness/base/processes.h"
#include "harness/input/document.h"

namespace trammel::harness {

/// What one computation needs at most, from its case alone, before anything is built.
struct SizeEstimate {
  double coordinates = 0;  ///< of the model before constraints
  double non_zeros = 0;    ///< of a factor of its stiffness, in a fill-reducing order
  double bytes = 0;        ///< of all
  std::string cause;       ///< pointer to the key that most of it is due to
};

/// Coordinates are counted; non-zeros are 12 a coordinate of members and, as nested dissection
/// leaves in the plane (George 1973), 16 log2(n) a coordinate of n in a mesh; dense solutions,
/// modes, samples, points of paths and cells of grids with what is kept of each.
[[nodiscard]] SizeEstimate estimate_size(const Document& document);

/// @throws InputError  at the key that is the cause, where the estimate is above so many bytes, or
///                     a factor has more entries than 32 bits can count.
void require_fits(const Document& document,
                  double max_memory = static_cast<double>(memory_limit_bytes()));

}  // namespace trammel::harness
