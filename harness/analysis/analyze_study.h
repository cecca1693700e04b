#pragma once

#include "harness/input/case.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Runs another analysis at each value of a parameter. Every recorded quantity has one number per
/// value.
AnalyseCase analyze_study;

/// Runs every combination of some options on the variants and levels of other cases. Records
/// outcomes, non-finite numbers, incomplete reasons, and differences between results that must
/// agree.
AnalyseCase analyze_options;

/// Records relative_difference and difference_percent between pairs of references, by name.
AnalyseCase analyze_comparison;

/// Records stored probabilities of readings of a model (log_evidence, class_count,
/// class_entropy_bits, ...). Each quantity has one number per discrepancy, for each printed row.
AnalyseCase analyze_model_probabilities;

/// Returns the levels of a study, each with the inner analysis in place of the study.
[[nodiscard]] std::vector<Level> study_levels(const Document& document);

}  // namespace trammel::harness
