#pragma once

#include <cstdint>

/// How often this program has called malloc (Eigen's storage as well as operator new); -1 under a
/// sanitizer, which needs malloc for itself.
[[nodiscard]] std::int64_t allocations();
