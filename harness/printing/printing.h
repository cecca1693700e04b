#pragma once

#include <string>
#include <vector>

#include "harness/analysis/case_effects.h"
#include "harness/base/rows.h"
#include "harness/results/results.h"

namespace trammel::harness {

/// Return the columns of a table of checks, and the cells of one check: verdict, name, quantity,
/// numbers and tolerance.
[[nodiscard]] std::vector<Column> columns_of_checks();
[[nodiscard]] std::vector<Json> cells_of_check(const results::Check& check, bool with_index = true);

/// Prints status, warnings and the worst value of each check of a run. Also prints the values of
/// the run's quantities if `with_values` is true, if the run has no checks, or if the run has
/// estimates of discretization errors.
void print_run(const results::Run& run, bool with_values = false);

/// Prints the discretizations tried for the option --accuracy, with their estimated errors.
void print_tried_settings(const results::ErrorEstimates& errors);

/// Prints the fraction of refinement levels on which the numerical uncertainty (grid convergence
/// index, GCI) covers the exact value, and the median ratio of GCI to true error.
void print_numerical_uncertainty(const results::Results& results);

void print_summary(const results::Results& results);

/// Prints the effects of a case. For automatically selected effects, also prints their
/// dimensionless numbers and the changes of the results.
void print_effects(const EffectChoice& choice);

/// Returns the names of effects as a list: "axial-flexibility, shear and gravity", or "none".
[[nodiscard]] std::string effect_names(solver::Effects effects);

}  // namespace trammel::harness
