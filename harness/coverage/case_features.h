#pragma once

#include <set>
#include <string>

#include "harness/base/json.h"

/// Which features of the case schema a case uses.
namespace trammel::harness {

/// A key ("slider.rail"), or a value of an enumeration ("beam = timoshenko"), below "model",
/// "analysis" and "effects". Keys inside a definition of the schema carry its name.
using CaseFeatures = std::set<std::string>;

/// All that a case can use.
[[nodiscard]] CaseFeatures features_of_schema();

/// @param document  resolved, and obeys the schema
[[nodiscard]] CaseFeatures features_of(const Json& document);

/// The key below "analysis".
[[nodiscard]] std::string analysis_name(const Json& document);

/// Those that say what a model is made of: parts, elements and joints.
[[nodiscard]] CaseFeatures parts_of(const CaseFeatures& features);

}  // namespace trammel::harness
