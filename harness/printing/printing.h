#pragma once

#include <string>
#include <vector>

#include "harness/analysis/case_effects.h"
#include "harness/base/rows.h"
#include "harness/results/results.h"

namespace trammel::harness {

/// Columns and cells of a check: verdict, name, quantity, numbers and tolerance.
[[nodiscard]] std::vector<Column> check_columns();
[[nodiscard]] std::vector<Json> check_cells(const results::Check& check, bool with_index = true);

/// Status, warnings and the worst entry of each check; of a run without checks its quantities.
void print_run(const results::Run& run);

/// The settings that a search for an accuracy has tried, with their estimated errors.
void print_search(const results::ErrorEstimates& errors);
/// The validation comparison (ASME V&V 20) of a run as a table, if it has one.
void print_validation(const results::Run& run);

/// Hit rate and width of the bands of numerical uncertainty in one line, if exact values exist.
void print_numerical_uncertainty(const results::Results& results);

/// Counts of runs, verdicts and validation comparisons.
void print_summary(const results::Results& results);

/// Prints the effects of a case; of automatic ones also numbers, changes and reasons.
void print_effects(const EffectChoice& choice);

/// "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(solver::Effects effects);

}  // namespace trammel::harness
