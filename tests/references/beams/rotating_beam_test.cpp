// ctest: labels=verification
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(rotating_beam)

using namespace trammel::references;
using namespace trammel::testing;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(rotating_beams_agree_with_values_computed_elsewhere) {
  check_equal(
      run("rotating-beam-roots", R"({"eta": 12, "hub_ratio": 0, "plane": "flap", "count": 3})"),
      {13.1701504875, 37.6031123312, 79.6144784895}, 1e-11);
  check_equal(
      run("rotating-beam-roots", R"({"eta": 50, "hub_ratio": 1, "plane": "flap", "count": 1})"),
      {std::sqrt(std::pow(run("rotating-beam-roots",
                              R"({"eta": 50, "hub_ratio": 1, "plane": "lag", "count": 1})")[0],
                          2) +
                 2500)},
      1e-14);
  check_equal(
      run("rotating-beam-roots", R"({"eta": 10, "hub_ratio": 1, "plane": "lag", "count": 1})"),
      {13.2578764078}, 1e-11);
}

BOOST_AUTO_TEST_CASE(a_speed_that_fifty_digits_cannot_hold_is_refused) {
  BOOST_CHECK_THROW(static_cast<void>(run("rotating-beam-roots",
                                          R"({"eta": 50, "hub_ratio": 5, "plane": "flap",
                                              "count": 1})")),
                    DerivationError);
}

BOOST_AUTO_TEST_CASE(a_hub_at_rest_carries_an_ordinary_cantilever) {
  check_equal(
      run("rotating-beam-roots", R"({"eta": 0, "hub_ratio": 1, "plane": "flap", "count": 3})"),
      {3.51601526850015118, 22.0344915646667699, 61.697214413549102}, 4e-16);
}

BOOST_AUTO_TEST_CASE(the_coriolis_coupling_vanishes_with_axial_rigidity_and_lowers_bending) {
  const auto lag = [](const char* axial) {
    return run(
        "rotating-beam-roots",
        (std::string(R"({"eta": 5, "hub_ratio": 1, "plane": "lag", "count": 2)") + axial + "}")
            .c_str());
  };
  const auto rigid = lag("");
  check_equal(lag(R"(, "axial_ratio": 1e12)"), rigid, 1e-9);
  const auto flexible = lag(R"(, "axial_ratio": 1e5)");
  BOOST_TEST(flexible[0] < rigid[0]);
  // the loss goes as one over the axial stiffness
  const auto stiffer = lag(R"(, "axial_ratio": 1e6)");
  BOOST_TEST((rigid[0] - flexible[0]) / (rigid[0] - stiffer[0]) == 10.0, tolerance(1e-2));
}

BOOST_AUTO_TEST_SUITE_END()
