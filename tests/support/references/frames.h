#pragma once

#include <boost/test/unit_test.hpp>
#include <vector>

#include "references/numerics/arguments.h"
#include "references/programs/program.h"

/// Frames that several tests of the derivations share.
namespace trammel::testing {

using namespace references;

/// Returns an aluminum beam from A(0, 0) to B(1, 0) with a merge patch of the model.
inline Json beam_model(const char* patch) {
  Json model = Json::parse(R"({
    "materials": {"aluminium": {"E_Pa": 6.9e10, "rho_kg_m3": 2700, "nu": 0.33}},
    "sections": {"bar": {"material": "aluminium",
                         "rectangle": {"thickness_m": 0.01, "width_m": 0.03}}},
    "nodes": {"A": [0, 0], "B": [1, 0]},
    "members": {"AB": {"nodes": ["A", "B"], "section": "bar"}}})");
  model.merge_patch(Json::parse(patch));
  return model;
}

inline std::vector<double> frequencies(const Json& model, int count) {
  return derive_values("frame-frequencies", {{"model", model}, {"count", count}});
}

/// Runs a program with arguments as JSON text. @returns its values
inline std::vector<double> run(const char* program, const char* arguments) {
  return derive_values(program, Json::parse(arguments));
}

inline void check_equality(const std::vector<double>& a, const std::vector<double>& b,
                           double relative) {
  BOOST_TEST_REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    BOOST_TEST(a[i] == b[i], boost::test_tools::tolerance(relative));
}

}  // namespace trammel::testing
