#pragma once

#include "harness/input/case.h"
#include "harness/statics_modes/step_result.h"

namespace trammel::harness {

/// Runs another analysis for each value of a parameter. Every recorded quantity has one number per
/// value.
AnalyseCase analyze_study;

/// Runs other cases with every combination of some options of their analyses. Records how many
/// combinations have each outcome, return a non-finite number, or fail without a sufficient reason.
/// Also records the largest difference between results that must not depend on the options.
AnalyseCase analyze_options;

/// Records the quantities relative_difference and difference_percent for pairs of references.
AnalyseCase analyze_comparison;

/// Records stored probabilities of readings of a printed table. Readings are models that its
/// authors may have used. The quantities are log_evidence, class_count, class_entropy_bits, ...
/// Each row of the table has its own quantities, with one number per assumed discrepancy of the
/// printed values.
AnalyseCase analyze_model_probabilities;

/// Returns a case for each parameter value of a study. The analysis of these cases is the analysis
/// that the study repeats.
[[nodiscard]] std::vector<Level> study_levels(const Document& document);

}  // namespace trammel::harness
