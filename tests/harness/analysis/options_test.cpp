#include <boost/test/unit_test.hpp>
#include <set>

#include "harness/analysis/analysis.h"
#include "harness/input/catalogue.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(options)

using namespace trammel;
using namespace trammel::references;
using namespace trammel::solver;
using namespace trammel::testing;

namespace {

/// Motion of a pendulum. In some tests it requires more time steps than the option `steps` permits.
const char* const pendulum = R"({"id": "pendulum", "title": "t",
  "model": {"nodes": {"O": [0, 0], "B": [-1, 0]}, "rigid_bodies": {"rod": {"reference": "O", "nodes": ["B"]}},
            "point_masses": {"bob": {"node": "B", "mass_kg": 1}}, "supports": {"O": ["x", "y"]},
            "gravity_m_s2": [0, -9.81]},
  "analysis": {"large-motion": {"end_time_s": 1, "step_s": 0.01}},
  "variants": {"fine": {"analysis": {"large-motion": {"step_s": 0.001}}}}})";

Quantities tried(const Json& of) {
  const Folder folder;
  static_cast<void>(folder.write("pendulum.json", pendulum));
  const Json json = {
      {"id", "options"},
      {"title", "t"},
      {"analysis", {{"options", {{"cases", {{"pendulum", Json::object()}}}, {"analyses", of}}}}}};
  const References references;
  return analyze(patched(load_case(folder.write(json)), "base"), references, {false}).quantities;
}

double number(const Quantities& quantities, const char* name) {
  return quantities.at(name).values.at(0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_option_combination_is_tried_on_every_variant) {
  const Quantities found =
      tried({{"large-motion",
              {{"vary", {{"mass_damping_per_s", {0, 1, 2}}, {"spectral_radius", {0.5, 1}}}}}}});
  BOOST_TEST(number(found, "attempted") == 12);
  BOOST_TEST(number(found, "attempted:pendulum") == 12);
  BOOST_TEST(number(found, "solved") == 12);
  BOOST_TEST(number(found, "not_finite") == 0);
}

BOOST_AUTO_TEST_CASE(failure_without_required_words_counts_as_unexplained) {
  const Json set = {{"steps", 3}};
  const Json said = {{"large-motion", {{"set", set}, {"reason_contains", {"step", "time"}}}}};
  BOOST_TEST(number(tried(said), "not_converged") == 2);
  BOOST_TEST(number(tried(said), "unexplained") == 0);
  const Json unsaid = {{"large-motion", {{"set", set}, {"reason_contains", {"moonshine"}}}}};
  BOOST_TEST(number(tried(unsaid), "unexplained") == 2);
}

BOOST_AUTO_TEST_CASE(refused_option_values_do_not_stop_the_others) {
  const Quantities found = tried({{"large-motion", {{"vary", {{"spectral_radius", {1, 17}}}}}}});
  BOOST_TEST(number(found, "refused") == 2);
  BOOST_TEST(number(found, "solved") == 2);
}

BOOST_AUTO_TEST_CASE(different_run_status_is_an_infinite_difference) {
  const Quantities found =
      tried({{"large-motion", {{"vary", {{"steps", {3, 100000}}}}, {"same_results", true}}}});
  BOOST_TEST(number(found, "result_difference_over_roundoff") > 1e300);
}

BOOST_AUTO_TEST_CASE(every_item_of_the_stress_suite_has_a_case) {
  std::set<int> items;
  for (const Case& one : Catalogue().load({"hard"})) {
    const Json& document = one.document.value();
    BOOST_TEST(document.contains("stress_suite"), one.id());
    if (document.contains("stress_suite"))
      items.insert(document["stress_suite"]["item"].get<int>());
  }
  BOOST_TEST(items.size() == 21U);
  BOOST_TEST(*items.rbegin() == 21);
}

BOOST_AUTO_TEST_SUITE_END()
