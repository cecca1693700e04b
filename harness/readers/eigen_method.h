#pragma once

#include "harness/input/json_view.h"
#include "solver/linalg/eigenpairs.h"

namespace trammel::harness {

/// Key "eigensolver" of an analysis: automatic, dense or sparse.
[[nodiscard]] solver::EigenMethod read_eigen_method(const JsonView& analysis);

}  // namespace trammel::harness
