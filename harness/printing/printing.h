#pragma once

#include <string>
#include <vector>

#include "harness/analysis/case_effects.h"
#include "harness/base/rows.h"
#include "harness/results/results.h"

namespace trammel::harness {

/// Return columns and cells of a check: verdict, name, quantity, numbers and tolerance.
[[nodiscard]] std::vector<Column> check_columns();
[[nodiscard]] std::vector<Json> check_cells(const results::Check& check, bool with_index = true);

/// Prints status, warnings and the worst entry of each check; for a run without checks, its
/// quantities.
void print_run(const results::Run& run);

/// Prints the discretizations tried in the search for an accuracy, with their estimated errors.
void print_search(const results::ErrorEstimates& errors);
/// Prints the validation comparison (ASME V&V 20) of a run as a table, if it has one.
void print_validation(const results::Run& run);

/// Prints hit rate and width of the numerical uncertainty bands in one line, if exact values exist.
void print_numerical_uncertainty(const results::Results& results);

/// Prints the numbers of runs, verdicts and validation comparisons.
void print_summary(const results::Results& results);

/// Prints the effects of a case. Automatic effects also show numbers, changes and reasons.
void print_effects(const EffectChoice& choice);

/// Returns "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(solver::Effects effects);

}  // namespace trammel::harness
