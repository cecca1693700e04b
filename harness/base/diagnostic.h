#pragma once

#include <string>

namespace trammel::harness {

/// Whether a quantity says how well others were computed (round-off, residuals): smaller is better,
/// and nothing converges to its limit.
[[nodiscard]] bool is_diagnostic(const std::string& name);

}  // namespace trammel::harness
