// ctest: labels=verification
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(frame_buckling)

using namespace trammel::references;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(columns_buckle_at_their_textbook_loads) {
  check_equal(run("column-buckling", R"({"ends": "clamped-pinned", "load": "end", "count": 1})"),
              {4.49340945790906 * 4.49340945790906}, 1e-14);
  check_equal(
      run("column-buckling", R"({"ends": "clamped-free", "load": "self-weight", "count": 1})"),
      {7.8373474389}, 1e-10);
}

BOOST_AUTO_TEST_CASE(a_frame_of_one_column_buckles_as_the_column_does) {
  const auto factor = [](const char* supports) {
    Json model = beam_model(R"({"loads": {"end": {"node": "B", "force_N": [-1, 0]}}})");
    model["supports"] = Json::parse(supports);
    return derive("frame-buckling", {{"model", model}, {"count", 2}});
  };
  const auto column = [](const char* ends) {
    return derive("column-buckling",
                  {{"ends", ends}, {"load", "end"}, {"count", 2}, {"EI_N_m2", kBeamEI}});
  };
  check_equal(factor(R"({"A": ["x", "y", "rotation"]})"), column("clamped-free"), 1e-15);
  check_equal(factor(R"({"A": ["x", "y", "rotation"], "B": ["y"]})"), column("clamped-pinned"),
              1e-15);
  check_equal(factor(R"({"A": ["x", "y", "rotation"], "B": ["y", "rotation"]})"),
              column("clamped-clamped"), 1e-15);
}

BOOST_AUTO_TEST_CASE(a_pinned_beam_under_axial_force_has_its_closed_form) {
  const double pi = std::acos(-1.0);
  for (const double N : {-1000.0, 1e-3, 5000.0}) {
    Json model = beam_model(R"({"supports": {"A": ["x", "y"], "B": ["x", "y"]}})");
    model["members"]["AB"]["axial_force_N"] = N;
    std::vector<double> expected;
    for (int n = 1; n <= 4; ++n) {
      expected.push_back(n / 2.0 * std::sqrt((N + kBeamEI * std::pow(n * pi, 2)) / 0.81));
    }
    check_equal(frequencies(model, 4), expected, 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
