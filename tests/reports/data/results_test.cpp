#include "reports/data/results.h"

#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/reports/workspace.h"

BOOST_AUTO_TEST_SUITE(results)

using namespace trammel::testing;
using nlohmann::ordered_json;
using trammel::results::read_results;

namespace {

/// Change of the sample's results.json: a new value at a JSON pointer; an empty text removes the
/// value.
struct Refusal {
  const char *pointer, *value, *message;
};

const Refusal kRefusals[] = {
    {"/runs", "", "/runs: expected a value, found nothing"},
    {"/format", "3", "/format: expected 1 or 2"},
    {"/runs/0/status", "\"done\"",
     "/runs/0/status: expected one of solved singular not-converged error not-run cannot "
     "not-exported crashed timed-out"},
    {"/runs/0/case", "\"nowhere\"", "/runs/0/case: expected a case listed under /cases"},
    {"/runs/0/checks/0/computed", "\"16\"", "/runs/0/checks/0/computed: expected a number"},
    {"/runs/0/checks/0/verdict", "", "/runs/0/checks/0/verdict: expected a value, found nothing"},
    {"/runs/0/drawing/members/0/1", "99",
     "/runs/0/drawing/members/0/1: expected an integer from 0 to 32"},
    {"/runs/0/drawing/shapes/0/displacement_m/0", "",
     "/runs/0/drawing/shapes/0/displacement_m: expected one pair of numbers per node, 33"}};

std::ostream& operator<<(std::ostream& out, const Refusal& refusal) {
  return out << refusal.pointer << " " << refusal.value;
}

std::string refusal_message(const std::string& text) {
  const Workspace workspace;
  const auto file = workspace.path() / "results.json";
  std::ofstream(file) << text;
  try {
    (void)read_results(file);
  } catch (const std::runtime_error& error) {
    const std::string what = error.what(), name = file.string() + ": ";
    BOOST_TEST(what.rfind(name, 0) == 0U, what << " does not name the file");
    return what.substr(name.size());
  }
  return "nothing";
}

}  // namespace

BOOST_DATA_TEST_CASE(invalid_value_is_refused_with_its_pointer, kRefusals, refusal) {
  ordered_json json = to_json(sample_results());
  const std::string value = refusal.value;
  ordered_json step = {{"op", value.empty() ? "remove" : "replace"}, {"path", refusal.pointer}};
  if (!value.empty()) step["value"] = ordered_json::parse(value);
  BOOST_TEST(refusal_message(json.patch(ordered_json::array({step})).dump()) == refusal.message);
}

BOOST_AUTO_TEST_CASE(text_that_is_not_json_is_refused_with_its_byte) {
  BOOST_TEST(refusal_message("{\"format\": 1,, }") == "not JSON at byte 14");
  const Workspace workspace;
  BOOST_CHECK_EXCEPTION((void)read_results(workspace.path() / "none.json"), std::runtime_error,
                        [](const auto& error) {
                          return std::string(error.what()).find("not readable") !=
                                 std::string::npos;
                        });
}

BOOST_AUTO_TEST_CASE(usual_fields_of_a_check_are_left_out_and_restored) {
  const auto first = sample_results();
  const ordered_json text = to_json(first);
  const auto again = read_results(text);
  std::size_t left_out = 0;
  for (std::size_t r = 0; r < first.runs.size(); ++r)
    for (std::size_t c = 0; c < first.runs[r].checks.size(); ++c) {
      const auto &a = first.runs[r].checks[c], &b = again.runs[r].checks[c];
      BOOST_TEST((a.role == b.role && a.measure == b.measure && a.unit == b.unit &&
                  a.index == b.index && a.title == b.title && a.message == b.message &&
                  a.why == b.why && a.computed == b.computed),
                 a.name);
      for (const char* key : {"role", "measure", "unit"})
        left_out += text["runs"][r]["checks"][c].contains(key) ? 0 : 1;
    }
  BOOST_TEST(left_out > 100U);
}

BOOST_AUTO_TEST_SUITE_END()
