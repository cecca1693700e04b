#pragma once

#include "harness/scene/case_model.h"

namespace trammel::harness {

/// Calls `work` and returns its result.
/// @throws InputError  (see `to_input_error`) if the solver throws ModelError for an invalid model.
template <class Work>
auto rethrow_as_input_error(const Document& document, const Work& work) {
  try {
    return work();
  } catch (const solver::ModelError& error) {
    throw to_input_error(document, error);
  }
}

}  // namespace trammel::harness
