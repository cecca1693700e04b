// ctest: labels=verification
#include "references/beams/beam_modes.h"

#include <boost/test/unit_test.hpp>
#include <string>
#include <vector>

#include "references/numerics/real.h"
#include "references/programs/program.h"

BOOST_AUTO_TEST_SUITE(beam_modes)

using namespace trammel::references;

namespace {

struct Known {
  const char* ends;
  std::vector<double> roots;
};

/// Roots computed elsewhere with 40 digits.
const std::vector<Known> known = {
    {"clamped-free",
     {1.87510406871196117, 4.69409113297417458, 7.85475743823761256, 10.995540734875467,
      14.1371683910464706, 17.2787595320882363}},
    {"clamped-clamped",
     {4.73004074486270403, 7.85320462409583756, 10.9956078380016709, 14.1371654912574642,
      17.2787596573994814, 20.4203522456260611}},
    {"free-free", {4.73004074486270403, 7.85320462409583756}},
    {"clamped-pinned",
     {3.92660231204791878, 7.06858274562873209, 10.2101761228130305, 13.3517687777540931,
      16.4933614313464098, 19.6349540849362077}},
    {"clamped-guided",
     {2.36502037243135201, 5.49780391900083545, 8.63937982869974072, 11.7809724510202275,
      14.9225651045516271}},
};

}  // namespace

BOOST_AUTO_TEST_CASE(classical_roots_agree_with_those_computed_elsewhere) {
  for (const Known& beam : known) {
    BOOST_TEST_CONTEXT(beam.ends) {
      const auto roots = to_doubles(beam_roots({beam.ends}, static_cast<int>(beam.roots.size())));
      for (std::size_t i = 0; i < roots.size(); ++i) {
        BOOST_TEST(roots[i] == beam.roots[i], boost::test_tools::tolerance(4e-16));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tip_mass_and_its_inertia_lower_every_root) {
  const auto bare = beam_roots({"clamped-free"}, 4);
  const auto mass = beam_roots({"clamped-free", 1.0}, 4);
  const auto both = beam_roots({"clamped-free", 1.0, 0.01}, 4);
  const std::vector<double> mass_known = {1.247917409606469, 4.03113943671496, 7.134132240939746,
                                          10.25662107371403};
  const std::vector<double> both_squared = {1.54367680341, 13.2395885595, 32.0695808101,
                                            66.8286762291};
  for (std::size_t i = 0; i < 4; ++i) {
    BOOST_TEST(mass[i] < bare[i]);
    BOOST_TEST(both[i] < mass[i]);
    BOOST_TEST(static_cast<double>(mass[i]) == mass_known[i], boost::test_tools::tolerance(1e-15));
    BOOST_TEST(static_cast<double>(both[i] * both[i]) == both_squared[i],
               boost::test_tools::tolerance(1e-11));
  }
}

BOOST_AUTO_TEST_CASE(the_hundredth_root_is_as_exact_as_the_first) {
  const auto roots = beam_roots({"pinned-pinned"}, 100);
  BOOST_TEST(static_cast<double>(abs(roots[99] - 100 * pi<Real>())) < 1e-40);
}

BOOST_AUTO_TEST_CASE(unusable_arguments_are_named_by_their_pointer) {
  const auto message = [](const char* arguments) {
    try {
      static_cast<void>(derive("beam-roots", Json::parse(arguments)));
    } catch (const DerivationError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  BOOST_TEST(message(R"({"count": 3})") == "/ends: is missing");
  BOOST_TEST(message(R"({"ends": "clamped-free", "count": 0})") ==
             "/count: expected a whole number from 1 to 1000");
  BOOST_TEST(message(R"({"ends": "clamped-free", "count": 3, "mass": 1})").find("/mass: no such") ==
             0U);
  BOOST_TEST(
      message(R"({"ends": "free-free", "count": 3, "tip_mass_ratio": 1})").find("/tip_mass") == 0U);
  BOOST_CHECK_THROW(static_cast<void>(derive("no-such", Json::object())), DerivationError);
}

BOOST_AUTO_TEST_SUITE_END()
