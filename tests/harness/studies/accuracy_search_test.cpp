#include "harness/studies/accuracy_search.h"

#include <boost/test/unit_test.hpp>

#include "harness/analysis/analysis.h"
#include "tests/support/harness/support.h"

BOOST_AUTO_TEST_SUITE(accuracy_search)

using namespace trammel;
using namespace trammel::testing;

namespace {

AccuracySearch searched(const Json& json, const AccuracyRequest& request) {
  const Folder folder;
  const References references;
  const auto compute = [&](const Setting& setting, int time_limit_s) {
    return run_sandboxed(setting, time_limit_s, references);
  };
  return search_accuracy(load_case(folder.write(json)), kBaseVariant, request, compute, {});
}

Json with_modes() {
  Json json = testing::cantilever();
  json["analysis"] = {{"modes", {{"count", 2}}}};
  return json;
}

}  // namespace

BOOST_AUTO_TEST_CASE(found_settings_are_within_the_accuracy) {
  const AccuracySearch found = searched(with_modes(), {1e-3, {}, 60});
  BOOST_TEST(!found.out_of_time);
  BOOST_TEST(found.reference_change <= 1e-4);
  BOOST_TEST_REQUIRE(found.study.settings.size() >= 2U);
  BOOST_TEST(found.study.settings.size() == found.patches.size());
  bool any_too_coarse = false;
  for (const TriedSetting& tried : found.tried) any_too_coarse |= tried.error > 1e-3;
  BOOST_TEST(any_too_coarse);
}

BOOST_AUTO_TEST_CASE(the_patch_makes_the_case_compute_what_was_measured) {
  const AccuracySearch found = searched(with_modes(), {1e-3, {"frequency_Hz"}, 60});
  const std::vector<double>& exact = found.study.settings.back().observed.front().exact;
  Json json = with_modes();
  json.merge_patch(found.patches.back());
  const Folder folder;
  const References references;
  const AnalysisResult result =
      analyse(patched(load_case(folder.write(json)), kBaseVariant), references, {false});
  const std::vector<double>& frequency = result.quantities.at("frequency_Hz").values;
  for (std::size_t i = 0; i < 2; ++i)
    BOOST_TEST(frequency.at(i) == exact.at(i), boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_CASE(large_displacement_is_chosen_where_required) {
  Json json = testing::cantilever();
  json["model"]["loads"]["tip"]["force_N"] = {0, 4e5};
  const AccuracySearch found = searched(json, {1e-3, {"displacement_y_m:B"}, 60});
  for (std::size_t i = 1; i < found.study.settings.size(); ++i)
    BOOST_TEST(contains(found.study.settings[i].title, "large displacement"));
  BOOST_TEST(found.study.settings.size() >= 2U);
}

BOOST_AUTO_TEST_CASE(impossible_search_is_refused_and_time_limited) {
  const auto refusal = [](const AccuracyRequest& request) {
    return complaint([&] { (void)searched(with_modes(), request); });
  };
  BOOST_TEST(contains(refusal({1e-3, {"frequncy_Hz"}, 60}), "did you mean 'frequency_Hz'"));
  Json unsolved = testing::cantilever();
  unsolved["model"].erase("supports");
  BOOST_TEST(contains(complaint([&] {
                        (void)searched(unsolved, {1e-3, {}, 60});
                      }),
                      "expected a case that is solved"));
  BOOST_TEST(searched(with_modes(), {1e-9, {}, 1e-9}).out_of_time);
}

BOOST_AUTO_TEST_CASE(a_case_that_does_not_end_is_ended_with_the_search) {
  BOOST_TEST(contains(complaint([&] {
                        (void)searched(testing::endless(), {1e-3, {}, 1});
                      }),
                      "not done after 1 s of processor time"));
}

BOOST_AUTO_TEST_SUITE_END()
