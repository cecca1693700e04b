#include "reports/data/results.h"

#include <boost/test/unit_test.hpp>
#include <fstream>

#include "tests/support/reports/sample.h"
#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(results)

using namespace trammel::testing;
using nlohmann::ordered_json;
using trammel::results::read_results;

namespace {

/// What is said of the sample after `patch` (a JSON Patch) has been applied to it.
std::string complaint(const ordered_json& patch) {
  const Workspace workspace;
  const auto file = workspace.results(sample_results().patch(patch));
  try {
    (void)read_results(file);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what();
    const std::string name = file.string() + ": ";
    BOOST_TEST(what.rfind(name, 0) == 0U, what << " does not name the file");
    BOOST_TEST(what.find('\n') == std::string::npos);
    return what.substr(name.size());
  }
  return "nothing";
}

ordered_json replace(const std::string& pointer, const ordered_json& value) {
  return {{{"op", "replace"}, {"path", pointer}, {"value", value}}};
}

ordered_json drop(const std::string& pointer) {
  return {{{"op", "remove"}, {"path", pointer}}};
}

}  // namespace

BOOST_AUTO_TEST_CASE(what_is_missing_or_wrong_is_named_by_its_pointer) {
  BOOST_TEST(complaint(drop("/runs")) == "/runs: expected a value, found nothing");
  BOOST_TEST(complaint(replace("/format", 2)) == "/format: expected 1");
  BOOST_TEST(complaint(replace("/runs/0/status", "done")) ==
             "/runs/0/status: expected one of solved singular not-converged error not-run cannot "
             "not-exported crashed timed-out");
  BOOST_TEST(complaint(replace("/runs/0/case", "nowhere")) ==
             "/runs/0/case: expected a case that stands under /cases");
  BOOST_TEST(complaint(replace("/runs/0/checks/0/computed", "16")) ==
             "/runs/0/checks/0/computed: expected a number");
  BOOST_TEST(complaint(drop("/runs/0/checks/0/verdict")) ==
             "/runs/0/checks/0/verdict: expected a value, found nothing");
  BOOST_TEST(complaint(replace("/runs/0/drawing/members/0/1", 99)) ==
             "/runs/0/drawing/members/0/1: expected an integer from 0 to 27");
  BOOST_TEST(complaint(drop("/runs/0/drawing/shapes/0/displacement_m/0")) ==
             "/runs/0/drawing/shapes/0/displacement_m: expected one pair of numbers a node, 28");
}

BOOST_AUTO_TEST_CASE(text_that_is_not_json_is_named_by_its_byte) {
  const Workspace workspace;
  const auto file = workspace.path() / "results.json";
  std::ofstream(file) << "{\"format\": 1,, }";
  BOOST_CHECK_EXCEPTION((void)read_results(file), std::runtime_error, [&](const auto& error) {
    return error.what() == file.string() + ": not JSON at byte 14";
  });
  BOOST_CHECK_EXCEPTION((void)read_results(workspace.path() / "none.json"), std::runtime_error,
                        [](const auto& error) {
                          return std::string(error.what()).find("cannot be read") !=
                                 std::string::npos;
                        });
}

BOOST_AUTO_TEST_CASE(a_number_that_is_not_there_is_empty_and_not_zero) {
  const Workspace workspace;
  const auto read = read_results(workspace.results(sample_results()));
  bool seen = false;
  for (const auto& run : read.runs)
    for (const auto& check : run.checks) {
      if (check.name != "inertia") continue;
      seen = true;
      BOOST_TEST(!check.computed.has_value());
      BOOST_TEST((check.verdict == trammel::results::Verdict::error));
    }
  BOOST_TEST(seen);
}

BOOST_AUTO_TEST_CASE(what_is_usual_of_a_check_is_left_out_and_read_as_if_it_stood_there) {
  const ordered_json whole = sample_results(), text = to_json(read_results(whole));
  std::size_t left_out = 0;
  for (std::size_t r = 0; r < whole["runs"].size(); ++r)
    for (std::size_t c = 0; c < whole["runs"][r]["checks"].size(); ++c) {
      const ordered_json &before = whole["runs"][r]["checks"][c],
                         &now = text["runs"][r]["checks"][c];
      const bool agrees = before.value("expectation", "agrees") == "agrees";
      BOOST_TEST(now.contains("role") ==
                 (before["role"] != (agrees ? "verification" : "validation")));
      const bool limited = !before.contains("expected") || before["expected"].is_null();
      BOOST_TEST(now.contains("measure") ==
                 (before["measure"] != (limited ? "bound" : "relative")));
      BOOST_TEST(now.contains("index") == !before["index"].is_null());
      left_out += now.contains("unit") ? 0 : 1;
    }
  BOOST_TEST(left_out > 100U);
  const auto again = read_results(text), first = read_results(whole);
  for (std::size_t r = 0; r < first.runs.size(); ++r)
    for (std::size_t c = 0; c < first.runs[r].checks.size(); ++c) {
      const auto &a = first.runs[r].checks[c], &b = again.runs[r].checks[c];
      const bool same = a.role == b.role && a.measure == b.measure && a.unit == b.unit &&
                        a.index == b.index && a.title == b.title && a.message == b.message &&
                        a.why == b.why;
      BOOST_TEST(same, a.name);
    }
}

BOOST_AUTO_TEST_SUITE_END()
