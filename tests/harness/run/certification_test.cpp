#include "harness/run/certification.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

BOOST_AUTO_TEST_SUITE(certification)

using namespace trammel::harness;
namespace results = trammel::results;

namespace {

/// Returns a run with one check of two values, each with a tolerance of +-1e-9.
Configuration configuration(const std::string& name, double first, double second,
                            results::Verdict verdict = results::Verdict::pass) {
  results::Run run;
  run.case_id = "beam";
  run.variant = "base";
  run.status = results::Status::solved;
  for (const double computed : {first, second}) {
    results::Check check;
    check.name = "tip";
    check.index = static_cast<int>(run.checks.size());
    check.computed = computed;
    check.expected = 2;
    check.difference = computed - 2;
    check.tolerance = results::Tolerance{-1e-9, 1e-9, true};
    check.verdict = verdict;
    run.checks.push_back(check);
  }
  Configuration made{name, {}};
  made.results.runs.push_back(run);
  return made;
}

std::string changed_verdicts(const Certification& certificate) {
  std::string text;
  for (const VerdictFlip& flip : certificate.flips)
    text += flip.configuration + " " + flip.check + " " + flip.from + " " + flip.to + "; ";
  return text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(agreeing_digits_are_counted_and_the_worst_is_named) {
  const Certification found =
      certify({configuration("here", 2, 2), configuration("there", 2 + 2e-12, 2)});
  BOOST_TEST_REQUIRE(found.rows.size() == 1U);
  BOOST_TEST(found.rows[0].checks == 2U);
  BOOST_TEST(std::abs(found.rows[0].fewest_digits - 12) < 0.1);
  BOOST_TEST(found.rows[0].median_digits == 14, boost::test_tools::tolerance(1e-5));
  BOOST_TEST(found.rows[0].least_certain == "beam:base tip[0]");
  BOOST_TEST(found.flips.empty());
  BOOST_TEST(found.tight.empty());
}

BOOST_AUTO_TEST_CASE(tolerance_below_ten_times_round_off_is_reported) {
  const Certification found =
      certify({configuration("here", 2, 2), configuration("up", 2 + 2e-10, 2 - 5e-10),
               configuration("down", 2 - 3e-10, 2 + 1e-12)});
  BOOST_TEST_REQUIRE(found.tight.size() == 1U);
  BOOST_TEST(found.tight[0].check == "beam:base tip");
  BOOST_TEST(found.tight[0].configuration == "up");
  BOOST_TEST(std::abs(found.tight[0].noise - 5e-10) < 1e-14);
}

BOOST_AUTO_TEST_CASE(different_verdict_and_missing_check_are_reported) {
  Configuration short_one = configuration("short", 2, 2, results::Verdict::fail);
  short_one.results.runs[0].checks.pop_back();
  const Certification found = certify({configuration("here", 2, 2), short_one});
  BOOST_TEST(found.rows[0].missing == 1U);
  BOOST_TEST(changed_verdicts(found) ==
             "short beam:base tip[0] pass fail; short beam:base tip[1] pass missing; ");
  const Certification more = certify({short_one, configuration("whole", 2, 2)});
  BOOST_TEST(changed_verdicts(more) ==
             "whole beam:base tip[0] fail pass; whole beam:base tip[1] missing pass; ");
}

BOOST_AUTO_TEST_CASE(worst_entry_of_a_bound_may_differ) {
  for (const bool bound : {false, true}) {
    Configuration here = configuration("here", 2, 3), there = here;
    for (Configuration* one : {&here, &there}) {
      std::vector<results::Check>& checks = one->results.runs[0].checks;
      checks.erase(checks.begin() + (one == &here ? 0 : 1));
      if (bound) checks[0].expected.reset();
      if (!bound) checks[0].against_variant = "base";
    }
    const Certification found = certify({here, there});
    BOOST_TEST(found.rows[0].checks == 1U);
    BOOST_TEST(found.rows[0].fewest_digits == 16);
    BOOST_TEST(changed_verdicts(found).empty());
  }
}

BOOST_AUTO_TEST_CASE(different_status_and_missing_run_are_reported) {
  for (const auto status : {results::Status::not_converged, results::Status::error}) {
    Configuration other = configuration("other", 2, 2);
    other.results.runs[0].status = status;
    other.results.runs[0].checks.clear();
    const Certification found = certify({configuration("here", 2, 2), other});
    BOOST_TEST(found.rows[0].missing == 2U);
    BOOST_TEST(changed_verdicts(found) == "other beam:base solved " + to_string(status) + "; ");
  }
  Configuration late = configuration("late", 2, 2);
  late.results.runs[0].status = results::Status::error;
  late.results.runs[0].reason = "took more than 5 s";
  BOOST_TEST(changed_verdicts(certify({configuration("here", 2, 2), late})) ==
             "late beam:base solved error: took more than 5 s; ");
  const Certification none = certify({configuration("here", 2, 2), {"none", {}}});
  BOOST_TEST(changed_verdicts(none) == "none beam:base solved missing; ");
}

BOOST_AUTO_TEST_CASE(run_failing_in_each_configuration_is_reported_for_each) {
  Configuration here = configuration("here", 2, 2), there = configuration("there", 2, 2);
  for (Configuration* one : {&here, &there}) one->results.runs[0].status = results::Status::error;
  BOOST_TEST(changed_verdicts(certify({here, there})) ==
             "here beam:base error error; there beam:base error error; ");
  for (Configuration* one : {&here, &there})
    one->results.runs[0].status = results::Status::singular;
  BOOST_TEST(changed_verdicts(certify({here, there})).empty());
}

BOOST_AUTO_TEST_SUITE_END()
