#pragma once

#include "harness/cursor.h"
#include "solver/eigenpairs.h"

namespace trammel {

/// Key "path" of an analysis: automatic, dense or sparse.
[[nodiscard]] EigenPath read_eigen_path(const Cursor& analysis);

}  // namespace trammel
