#pragma once

#include <string>

namespace trammel::harness {

/// A message as one line: control characters as JSON escapes, words beyond 120 bytes cut.
[[nodiscard]] std::string one_line(const std::string& text);

}  // namespace trammel::harness
