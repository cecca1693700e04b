#pragma once

#include <string>
#include <vector>

#include "references/numerics/arguments.h"

/// Proofs of what programs derive (`Program::prove`), by their arguments.
namespace trammel::references {

[[nodiscard]] std::vector<std::string> prove_frame_frequencies(const Json& arguments);
[[nodiscard]] std::vector<std::string> prove_beam_roots(const Json& arguments);

}  // namespace trammel::references
