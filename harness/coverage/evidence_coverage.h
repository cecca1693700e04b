#pragma once

#include <set>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/results/results.h"

/// Coverage of the features of the case schema by kinds of evidence, such as published values.
namespace trammel::harness {

/// Features that a case uses below "model", "analysis" and "effects": keys ("slider.rail") and
/// values ("beam = timoshenko"). Keys inside a definition of the schema start with the name of the
/// definition, such as "slider".
using CaseFeatures = std::set<std::string>;

/// Returns all features that a case can use.
[[nodiscard]] CaseFeatures case_features_of_schema();

/// Returns the features used by a document with all patches applied, which satisfies the schema.
[[nodiscard]] CaseFeatures features_of_document(const Json& document);

/// Computes the coverage from the catalogue's data alone. There is a row for each key and value of
/// the case schema. Further rows are the pairs of an analysis and a part, element or joint in a
/// case, and the quantities recorded by an analysis.
///
/// A check of a case counts for the quantity that it judges, and for all features used by the model
/// and the analysis. The kinds of evidence are:
/// - "exact": closed form or independent derivation
/// - "published": values printed in publications
/// - "manufactured": manufactured solutions
/// - "code": another code
/// - "self-consistency": bounds, and comparisons of the solver with itself
///
/// @throws InputError  if a case cannot be read.
[[nodiscard]] std::vector<results::CoverageRow> evidence_coverage(const std::vector<Case>& cases,
                                                                  const References& references);

/// Adds the reasons for missing independent evidence from cases/schema/without_evidence.json.
/// @throws InputError  if the file contains a reason for an unknown or a verified feature.
void explain_missing_evidence(std::vector<results::CoverageRow>& rows);

/// Counts the runs that record each quantity, and the runs in which a check of the quantity passed.
void count_quantity_runs(const results::Results& results, std::vector<results::CoverageRow>& rows);

}  // namespace trammel::harness
