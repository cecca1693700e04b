#pragma once

#include <set>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/results/results.h"

/// Coverage of the program's features by evidence, grouped by the kind of evidence.
namespace trammel::harness {

/// A key ("slider.rail"), or a value of an enumeration ("beam = timoshenko"), below "model",
/// "analysis" and "effects". Keys inside a definition of the schema carry its name.
using CaseFeatures = std::set<std::string>;

/// Returns all features that a case can use.
[[nodiscard]] CaseFeatures features_of_schema();

/// @param document  resolved document that satisfies the schema
[[nodiscard]] CaseFeatures features_of(const Json& document);

/// Computes the coverage from the catalogue's data alone. There is a row for each key and value of
/// the case schema. Further rows are the pairs of an analysis and a part, element or joint in a
/// case, and the quantities recorded by an analysis.
///
/// A check of a case counts for the quantity that it judges, and for all features used by the model
/// and the analysis. The kinds of evidence are:
/// - "exact": closed form or independent derivation
/// - "published"
/// - "manufactured"
/// - "code": another code
/// - "self-consistency": bounds, and comparisons of the solver with itself
///
/// @throws InputError  if a case cannot be read.
[[nodiscard]] std::vector<results::CoverageRow> evidence_coverage(const std::vector<Case>& cases,
                                                                  const References& references);

/// Adds the reasons for missing independent evidence from cases/schema/without_evidence.json.
/// @throws InputError  if it contains a reason for an unknown feature or for one with such
///   evidence.
void add_reasons(std::vector<results::CoverageRow>& rows);

/// Counts the series of each quantity in the runs, and those judged by a check.
void count_series(const results::Results& results, std::vector<results::CoverageRow>& rows);

}  // namespace trammel::harness
