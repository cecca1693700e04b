#pragma once

#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// A general regression neural network on the samples of the inverse dynamics along the path:
/// smoothing, predictions, errors, skill, times.
[[nodiscard]] StepResult analyse_grnn(const JsonView& analysis, const CaseModel& case_model,
                                      bool draw, Recorder& record);

/// The same on samples of the case's own: predictions at its queries.
[[nodiscard]] StepResult analyse_grnn_samples(const Document& document,
                                              const References& references, bool draw,
                                              Recorder& record);

}  // namespace trammel::harness
