#pragma once

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "harness/analysis/analysis.h"
#include "tests/support/harness/support.h"

namespace trammel::testing {

using namespace references;
using namespace solver;
using namespace harness;

inline AnalysisResult analyze_json(const Json& json) {
  const References references;
  return analyze(document_of(json), references, {});
}

inline const std::vector<double>& values(const AnalysisResult& result, const std::string& name) {
  BOOST_REQUIRE_MESSAGE(result.quantities.count(name) == 1, name);
  return result.quantities.at(name).values;
}

/// Returns the single value of a quantity. Fails if the quantity has several values.
inline double only(const AnalysisResult& result, const std::string& name) {
  BOOST_REQUIRE_MESSAGE(values(result, name).size() == 1, name);
  return values(result, name).front();
}

}  // namespace trammel::testing
