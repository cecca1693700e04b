#pragma once

#include "harness/input/json_view.h"
#include "solver/linalg/eigenpairs.h"

namespace trammel {

/// Key "path" of an analysis: automatic, dense or sparse.
[[nodiscard]] EigenPath read_eigen_path(const Cursor& analysis);

}  // namespace trammel
