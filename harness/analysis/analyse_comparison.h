#pragma once

#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// relative_difference and difference_percent of references from each other, by name.
[[nodiscard]] StepResult analyse_comparison(const Document& document, const References& references,
                                            bool draw, Recorder& record);

/// Stored probabilities of readings of a model: log_evidence, class_count, class_entropy_bits ...
/// of each printed row, a number for each discrepancy.
[[nodiscard]] StepResult analyse_model_probabilities(const Document& document,
                                                     const References& references, bool draw,
                                                     Recorder& record);

}  // namespace trammel::harness
