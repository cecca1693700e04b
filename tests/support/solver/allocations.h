#pragma once

#include <cstdint>

/// Returns the number of calls of malloc, including Eigen's storage and operator new. With a
/// sanitizer, which replaces malloc itself, the number is -1.
[[nodiscard]] std::int64_t allocations();
