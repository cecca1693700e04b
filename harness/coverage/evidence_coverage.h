#pragma once

#include <set>
#include <string>
#include <vector>

#include "harness/base/json.h"
#include "harness/input/case.h"
#include "harness/input/reference_library.h"
#include "harness/results/results.h"

/// What of the program is verified by what kind of evidence, and what by none.
namespace trammel::harness {

/// A key ("slider.rail"), or a value of an enumeration ("beam = timoshenko"), below "model",
/// "analysis" and "effects". Keys inside a definition of the schema carry its name.
using CaseFeatures = std::set<std::string>;

/// All that a case can use.
[[nodiscard]] CaseFeatures features_of_schema();

/// @param document  resolved, and obeys the schema
[[nodiscard]] CaseFeatures features_of(const Json& document);

/// From the catalogue's data alone: a row for each key and value of the case schema, for each pair
/// of an analysis and a part, element or joint that a case has, and for each quantity that an
/// analysis records.
/// A check of a case counts for the quantity that it judges, and for all that the model and the
/// analysis use: of kind "exact" (closed form or independent derivation), "published",
/// "manufactured", "code" (another code), or "self-consistency" (bounds, and comparisons of the
/// solver with itself).
/// @throws InputError  where a case cannot be read.
[[nodiscard]] std::vector<results::CoverageRow> evidence_coverage(const std::vector<Case>& cases,
                                                                  const References& references);

/// Adds why features have no independent evidence, as cases/schema/without_evidence.json says it.
/// @throws InputError  where it states a reason for what is not there or has such evidence.
void add_reasons(std::vector<results::CoverageRow>& rows);

/// How many series the runs hold of each quantity, and how many of them a check has judged.
void count_series(const results::Results& results, std::vector<results::CoverageRow>& rows);

}  // namespace trammel::harness
