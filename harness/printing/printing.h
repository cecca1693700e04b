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

/// Prints status, warnings and the worst value of each check of a run. Also prints
/// the values of its quantities if `with_values` is true, if the run has no checks, or if its
/// discretization errors were estimated.
void print_run(const results::Run& run, bool with_values = false);

/// Prints the discretizations tried for the option --accuracy, with their estimated errors.
void print_tried_settings(const results::ErrorEstimates& errors);

/// Prints how often the numerical uncertainty (GCI) covers exact values, and how wide it is.
void print_numerical_uncertainty(const results::Results& results);

void print_summary(const results::Results& results);

/// Prints the effects of a case. For automatically selected effects, also prints their
/// dimensionless numbers and the changes of the results.
void print_effects(const EffectChoice& choice);

/// Returns the names of effects as a list: "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(solver::Effects effects);

}  // namespace trammel::harness
