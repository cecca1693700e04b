#pragma once

#include "harness/scene/case_model.h"

namespace trammel::harness {

/// Calls `work` and returns its result.
/// @throws InputError  (see `model_error`) if the solver throws ModelError for an invalid model.
template <class Work>
auto with_model_errors(const Document& document, const Work& work) {
  try {
    return work();
  } catch (const solver::ModelError& error) {
    throw model_error(document, error);
  }
}

}  // namespace trammel::harness
