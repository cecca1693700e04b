#pragma once

#include "harness/base/json.h"

namespace trammel::harness {

/// What produced the numbers: version, commit, date, compiler and flags, libraries, processor.
[[nodiscard]] Json environment();

}  // namespace trammel::harness
