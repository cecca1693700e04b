#pragma once

#include <iosfwd>
#include <vector>

#include "harness/run/run.h"

namespace trammel::harness {

/// The validation comparison of one run as a table: S, D, E with its uncertainties, the input that
/// matters most, and the verdict in words. Nothing where the case does not ask for it.
void print_validation(const Run& run, std::ostream& out);

/// How many comparisons of all runs came to which verdict, in one line; nothing where there are
/// none.
void print_validation_summary(const std::vector<Run>& runs, std::ostream& out);

/// Hit rate of the bands of numerical uncertainty, and how wide they are, in one line; nothing
/// where no exact value tells.
void print_numerical_uncertainty(const results::UncertaintyCoverage& summary, std::ostream& out);

}  // namespace trammel::harness
