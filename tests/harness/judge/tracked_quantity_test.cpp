#include <boost/test/unit_test.hpp>

#include "harness/judge/sweep.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(tracked_quantity)

using namespace trammel;
using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(each_statistic_of_a_quantity_is_tracked_separately) {
  const testing::Folder folder;
  Json json = testing::cantilever();
  const Json bound = {{"at_least", 0}, {"why", "w"}};
  const auto add_check = [&](const char* name, const char* statistic) {
    json["checks"][name] = {
        {"quantity", "displacement_y_m:B"}, {"role", "verification"}, {"bound", bound}};
    if (*statistic != '\0') json["checks"][name]["statistic"] = statistic;
  };
  add_check("largest", "max");
  add_check("smallest", "min");
  add_check("again", "max");
  add_check("whole", "");
  const Document document = patched(testing::read(folder, json), "base");
  const std::vector<TrackedQuantity> tracked =
      quantities_of_checks(document, read_checks(document, "base", {"base"}), References());
  BOOST_TEST(tracked.size() == 3U);
  BOOST_TEST(quantities_of_checks(document, {}, References()).empty());
}

BOOST_AUTO_TEST_CASE(result_of_another_code_is_not_an_exact_value) {
  const testing::Folder folder;
  Json json = testing::cantilever();
  json["checks"]["c"] = {
      {"quantity", "displacement_y_m:B"}, {"role", "validation"}, {"reference", "given"}};
  folder.write_reference("given", "m", -1, {{"absolute", 1}}, "code");
  const auto tracked = [&] {
    const Document document = patched(testing::read(folder, json), "base");
    const References references;
    const auto found =
        quantities_of_checks(document, read_checks(document, "base", {"base"}), references);
    return found.at(0).reference != nullptr;
  };
  BOOST_TEST(!tracked());
  json["checks"]["c"]["reference"] = "hard-07-displacement";
  BOOST_TEST(tracked());
}

BOOST_AUTO_TEST_SUITE_END()
