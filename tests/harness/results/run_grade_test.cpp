#include "harness/results/run_grade.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(run_grade)

using namespace trammel;
using namespace trammel::results;

namespace {

Run run_with(std::initializer_list<Verdict> verdicts) {
  Run run;
  run.status = Status::solved;
  for (const Verdict verdict : verdicts) run.checks.emplace_back().verdict = verdict;
  return run;
}

}  // namespace

BOOST_AUTO_TEST_CASE(run_with_a_failed_check_does_not_agree) {
  BOOST_TEST(to_string(grade_of_run(run_with({Verdict::pass}))) == "agrees");
  BOOST_TEST(to_string(grade_of_run(run_with({Verdict::pass, Verdict::error}))) == "broken");
  BOOST_TEST(to_string(grade_of_run(run_with({Verdict::pass, Verdict::fail}))) == "off");
}

BOOST_AUTO_TEST_CASE(grades_off_broken_crashed_and_timed_out_are_failures) {
  for (const Grade grade : {Grade::off, Grade::broken, Grade::crashed, Grade::timed_out})
    BOOST_TEST(is_failure(grade), to_string(grade));
  for (const Grade grade : {Grade::agrees, Grade::cannot, Grade::not_exported, Grade::not_given,
                            Grade::not_judged, Grade::not_run})
    BOOST_TEST(!is_failure(grade), to_string(grade));
}

BOOST_AUTO_TEST_SUITE_END()
