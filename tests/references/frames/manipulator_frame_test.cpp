// ctest: labels=verification
#include <boost/test/unit_test.hpp>
#include <string>

#include "tests/support/references/frames.h"

BOOST_AUTO_TEST_SUITE(manipulator_frame)

using namespace trammel::references;
using namespace trammel::testing;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(the_centred_manipulator_has_pairs_and_the_moved_one_has_none) {
  Json arguments = manipulator(R"({"count": 8})");
  const auto centred = derive("frame-frequencies", arguments);
  BOOST_TEST(centred[0] == centred[1], tolerance(1e-14));
  BOOST_TEST(centred[4] == centred[5], tolerance(1e-14));
  BOOST_TEST(centred[6] == centred[7], tolerance(1e-14));
  arguments["pose"] = {{"x_m", 0.26}, {"y_m", 0.144}, {"phi_rad", 0}};
  const auto moved = derive("frame-frequencies", arguments);
  for (std::size_t i = 1; i < moved.size(); ++i) BOOST_TEST(moved[i] > moved[i - 1] * (1 + 1e-4));
}

BOOST_AUTO_TEST_CASE(free_actuators_leave_as_many_rigid_motions_as_the_mechanism_has) {
  // At phi = 0 base and platform are homothetic, the lines A_i C_i meet in one point, and with
  // welded elbows the platform can turn as well: one motion more than at any other orientation.
  const auto below = [](const char* patch) {
    Json arguments = manipulator(patch);
    arguments["below_Hz"] = 1e-3;
    return derive("frame-count", arguments)[0];
  };
  BOOST_TEST(below(R"({"manipulator": {"joints": {"active": "free", "elbow": "hinged"}}})") == 3);
  BOOST_TEST(below(R"({"manipulator": {"joints": {"active": "free"}}})") == 1);
  BOOST_TEST(
      below(R"({"manipulator": {"joints": {"active": "free"}}, "pose": {"phi_rad": 0.1}})") == 0);
  BOOST_TEST(below(R"({"manipulator": {"joints": {"active": "locked"}}})") == 0);
}

BOOST_AUTO_TEST_CASE(an_unreachable_pose_and_a_missing_key_are_errors_with_their_place) {
  const auto message = [](const Json& arguments) {
    try {
      static_cast<void>(derive("frame-frequencies", arguments));
    } catch (const DerivationError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  BOOST_TEST(message(manipulator(R"({"count": 1, "pose": {"x_m": 3}})")).find("cannot reach") !=
             std::string::npos);
  BOOST_TEST(message(manipulator(R"({"count": 1, "manipulator": {"links": {"width_m": null}}})")) ==
             "/manipulator/links/width_m: is missing");
  BOOST_TEST(message({{"model", beam_model(R"({"members": {"AB": {"section": "none"}}})")},
                      {"count", 1}}) ==
             "/model/members/AB/section: expected the name of a section");
}

BOOST_AUTO_TEST_SUITE_END()
