#include "harness/input/check.h"

#include <boost/test/unit_test.hpp>

#include "harness/input/case.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(check)

using namespace trammel;
using namespace trammel::testing;

namespace {

Json case_expecting(const Json& expect) {
  Json json = testing::cantilever();
  json["variants"]["soft"]["description"] = "Softer.";
  json["variants"]["soft"]["checks"]["c"]["expect"] = Json::object();
  json["checks"]["c"] = {{"quantity", "frequency_Hz"},
                         {"reference", "row"},
                         {"role", "validation"},
                         {"expect", expect}};
  return json;
}

Check first_check(const Json& json, const std::string& variant = "base") {
  const Folder folder;
  const Case given = testing::read(folder, json);
  return read_checks(patched(given, variant), variant, given.variants()).at(0);
}

std::string fault(const Json& expect) {
  return input_error_message([&] { (void)first_check(case_expecting(expect)); });
}

}  // namespace

BOOST_AUTO_TEST_CASE(expected_values_share_the_half_width_within) {
  const Check each = first_check(
      case_expecting({{"agrees", "r"}, {"relative", {0.038, -0.106}}, {"within", 0.005}}));
  BOOST_TEST((each.measure == Measure::relative));
  BOOST_REQUIRE(each.windows.size() == 2);
  BOOST_TEST(each.windows[0].low == 0.033);
  BOOST_TEST(each.windows[0].high == 0.043);
  BOOST_TEST(each.windows[1].low == -0.111);
  BOOST_TEST(each.windows[1].high == -0.101);
  const Check one = first_check(case_expecting({{"agrees", "r"}, {"ratio", 2}, {"within", 0.5}}));
  BOOST_TEST((one.measure == Measure::ratio));
  BOOST_REQUIRE(one.windows.size() == 1);
  BOOST_TEST(one.windows[0].low == 1.5);
  BOOST_TEST(one.windows[0].high == 2.5);
}

BOOST_AUTO_TEST_CASE(variant_overrides_expected_value_and_reason) {
  Json json = case_expecting({{"known_discrepancy", "Reason."}, {"absolute", 2}, {"within", 0.5}});
  json["variants"]["soft"]["checks"]["c"]["expect"]["absolute"] = 1;
  const Check base = first_check(json);
  const Check soft = first_check(json, "soft");
  BOOST_TEST(base.why == "Reason.");
  BOOST_TEST(base.windows.at(0).low == 1.5);
  BOOST_TEST(soft.why == "Softer. Reason.");
  BOOST_TEST(soft.windows.at(0).low == 0.5);
}

BOOST_AUTO_TEST_CASE(check_applies_only_to_variants_that_it_names) {
  const auto applies_to = [](const Json& variants, const std::string& variant) {
    Json json = testing::cantilever();
    json["variants"]["soft"]["title"] = "Softer";
    json["checks"] = {{"c",
                       {{"quantity", "frequency_Hz"},
                        {"role", "verification"},
                        {"reference", "row"},
                        {"tolerance", {{"relative", 0.1}, {"why", "test"}}},
                        {"variants", variants}}}};
    const Folder folder;
    const Case given = testing::read(folder, json);
    return !read_checks(patched(given, variant), variant, given.variants()).empty();
  };
  for (const char* named : {"base", "soft"}) BOOST_TEST(applies_to({"base", "soft"}, named));
  BOOST_TEST(!applies_to({"soft"}, "base"));
}

BOOST_AUTO_TEST_CASE(quantity_is_not_judged_against_itself) {
  Json json = testing::cantilever();
  json["variants"]["soft"] = Json::object();
  Json& check = json["checks"]["c"];
  check = {{"quantity", "frequency_Hz"},
           {"against_quantity", "frequency_Hz"},
           {"role", "verification"},
           {"tolerance", {{"absolute", 1}, {"why", "w"}}}};
  BOOST_TEST(contains(input_error_message([&] { (void)first_check(json); }),
                      "/checks/c/against_quantity: a quantity cannot be compared with itself"));
  check["against_variant"] = "base";
  const Folder folder;
  const Case given = testing::read(folder, json);
  BOOST_TEST(read_checks(patched(given, "base"), "base", given.variants()).empty());
  BOOST_TEST(read_checks(patched(given, "soft"), "soft", given.variants()).size() == 1U);
}

BOOST_AUTO_TEST_CASE(check_that_cannot_fail_is_refused) {
  Json json = testing::cantilever();
  Json& check = json["checks"]["c"];
  check = {{"quantity", "frequency_Hz"},
           {"against_variant", "base"},
           {"role", "verification"},
           {"tolerance", {{"absolute", 1}, {"why", "w"}}}};
  BOOST_TEST(contains(input_error_message([&] { (void)first_check(json); }),
                      "/checks/c/against_variant: the case has no other variant"));
  check = {{"quantity", "frequency_Hz"},
           {"role", "validation"},
           {"expect", {{"agrees", "w"}, {"value_between", {nullptr, nullptr}}}}};
  BOOST_TEST(contains(input_error_message([&] { (void)first_check(json); }),
                      "/checks/c/expect/value_between: expected at least one"));
  check["expect"]["value_between"] = {nullptr, 1};
  BOOST_TEST(first_check(json).windows.at(0).high == 1);
}

BOOST_AUTO_TEST_CASE(half_width_requires_stated_values) {
  const Json agrees = {{"agrees", "r"}, {"within", 0.1}};
  const auto with = [](Json expect, const char* key, const Json& value) {
    expect[key] = value;
    return expect;
  };
  BOOST_TEST(contains(fault(with(agrees, "relative_between", {-1, 1})),
                      "/checks/c/expect: 'within' requires 'relative' (got "
                      "'relative_between')"));
  BOOST_TEST(contains(fault({{"agrees", "r"}, {"ratio", {1, 2}}}),
                      "/checks/c/expect: 'ratio' requires 'within'"));
  BOOST_TEST(contains(fault(agrees), "/checks/c/expect: expected exactly one of the keys"));
  BOOST_TEST(contains(fault(with(with(agrees, "relative", 1), "relative_between", {-1, 1})),
                      "/checks/c/expect: expected exactly one of the keys 'relative'"));
  BOOST_TEST(contains(fault({{"known_discrepancy", "r"}, {"relative", 0.1}, {"within", 0.2}}),
                      "/checks/c/expect/relative: expected a range without 0"));
}

BOOST_AUTO_TEST_SUITE_END()
