#pragma once

#include "harness/input/case.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Another analysis at each value of a parameter: every quantity kept has one number a value.
AnalyseCase analyse_study;

/// Every combination of some options tried on the variants and levels of other cases: their
/// outcomes, numbers that are not finite, incomplete reasons, and differences of those that must
/// agree.
AnalyseCase analyse_options;

/// Records relative_difference and difference_percent of references from each other, by name.
AnalyseCase analyse_comparison;

/// Stored probabilities of readings of a model: log_evidence, class_count, class_entropy_bits ...
/// of each printed row, a number for each discrepancy.
AnalyseCase analyse_model_probabilities;

/// The levels of a study, each with the inner analysis in the study's place.
[[nodiscard]] std::vector<Level> study_levels(const Document& document);

}  // namespace trammel::harness
