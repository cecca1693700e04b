#pragma once

#include "harness/input/case.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Runs another analysis for each value of a parameter. Every recorded quantity has one number per
/// parameter value.
AnalyseCase analyze_study;

/// Runs other cases with every combination of some options of their analyses. Records the number of
/// combinations with each outcome, with a non-finite number, or with a failure whose message lacks
/// required words. Also records the largest difference between results that must not depend on the
/// options.
AnalyseCase analyze_options;

/// Records the differences between the values of pairs of references, as the quantities
/// relative_difference and difference_percent.
AnalyseCase analyze_comparison;

/// Records probabilities that are stored in a reference: the probabilities of the models (readings)
/// that the authors of a printed table may have used. The quantities are log_evidence, class_count,
/// class_entropy_bits, ... Each row of the table has separate quantities, with one number per
/// assumed discrepancy of the printed values.
AnalyseCase analyze_model_probabilities;

/// Returns a case for each parameter value of a study. These cases have the analysis that the study
/// repeats for each value.
[[nodiscard]] std::vector<Level> cases_of_study_levels(const Document& document);

}  // namespace trammel::harness
