#pragma once

#include "solver/model/model.h"

namespace trammel::solver {

/// A path that has no meaning, or does not reach as far in time as it is asked.
class PathError : public ModelError {
 public:
  using ModelError::ModelError;
};

}  // namespace trammel::solver
