#pragma once

#include <vector>

#include "harness/analysis/model_probabilities.h"
#include "harness/input/reference_library.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// All readings of a case: what each predicts of its rows, and those that have no meaning.
struct ModelReadings {
  std::vector<ModelReading> readings;
  std::vector<results::ExcludedReadings> excluded;
};

/// One reading for each combination of an alternative of each factor, all equally probable; stored
/// readings share the rest of the probability. Within a reading its unknowns are the links'
/// thickness within its printed digits, the mesh between one element a link and the case's, one
/// stiffness for all sprung joints (its logarithm, evenly between the limits) and the pose: the
/// case's own, or any on a circle about it, with one half each.
[[nodiscard]] ModelReadings read_model_readings(const Document& document,
                                                const References& references);

/// A row of printed frequencies.
[[nodiscard]] PrintedRow printed_row(const references::Reference& reference);

/// log_evidence, class_count, class_entropy_bits ... of each row, a number for each discrepancy.
[[nodiscard]] StepResult analyse_model_probabilities(const Document& document,
                                                     const References& references, bool draw,
                                                     Recorder& record);

}  // namespace trammel::harness
