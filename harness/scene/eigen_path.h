#pragma once

#include "harness/input/json_view.h"
#include "solver/linalg/eigenpairs.h"

namespace trammel {

/// Key "path" of an analysis: automatic, dense or sparse.
[[nodiscard]] EigenMethod read_eigen_path(const JsonView& analysis);

}  // namespace trammel
