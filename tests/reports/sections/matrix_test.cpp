#include <boost/test/unit_test.hpp>
#include <string>

#include "reports/sections/sections.h"
#include "tests/support/reports/markup.h"

BOOST_AUTO_TEST_SUITE(matrix)

using namespace trammel::reports;
using trammel::testing::contains;

namespace {

/// Returns the check of one value against a target of 100 Hz.
Check check_of_one_value(const std::string& name, int entry, double difference) {
  Check check;
  check.name = name;
  check.role = "validation";
  check.measure = "relative";
  check.quantity = "frequency_Hz";
  check.reference = "printed";
  check.index = entry;
  check.expected = 100;
  check.computed = 100 * (1 + difference);
  check.difference = difference;
  check.verdict = Verdict::pass;
  return check;
}

/// Results of four variants. In each variant, the errors of modes 1, 2 and 3 are 10, 20 and 30 %.
struct Sample {
  Results results;
  Family family;

  Sample() {
    CaseInfo info;
    info.id = "modes";
    info.title = "Modes";
    for (const char* variant : {"a", "b", "c", "d"}) {
      info.variants.push_back({variant, variant});
      Run run;
      run.case_id = "modes";
      run.variant = variant;
      run.status = Status::solved;
      for (int entry = 0; entry < 3; ++entry)
        run.checks.push_back(check_of_one_value("program", entry, 0.1 * (entry + 1)));
      results.runs.push_back(run);
    }
    results.cases = {info};
  }

  /// Returns the conclusion of the matrix of a check, or an empty text.
  std::string conclusion(const Check& check) {
    family.cases = {&results.cases.front()};
    family.runs.clear();
    for (const Run& run : results.runs) family.runs.push_back(&run);
    std::string all;
    const Data matrices = comparison_matrices(family, results);
    for (const Data& matrix : matrices.list_value())
      if (text_variable(matrix, "check") == check.name) all += text_variable(matrix, "conclusion");
    return all;
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(conclusion_names_nearest_variant_of_missed_targets) {
  Sample sample;
  sample.results.runs[2].checks[0] = check_of_one_value("program", 0, 0.005);
  const std::string words = sample.conclusion(sample.results.runs[0].checks[0]);
  BOOST_TEST(contains(words, "Nearest overall: c,"), words);
  BOOST_TEST(contains(words, "No variant comes within 1\u202f% of modes 2 (nearest +20\u202f%)"),
             words);
}

BOOST_AUTO_TEST_CASE(check_against_another_mode_has_no_matrix_column) {
  // The check "shifted" compares mode 1 with the target of mode 2. The matrix once showed the
  // result of this check in the column of mode 1, as if the target of mode 1 was reached.
  Sample sample;
  for (int entry = 0; entry < 2; ++entry)
    sample.results.runs[1].checks.push_back(check_of_one_value("shifted", entry, 0.001));
  const std::string words = sample.conclusion(sample.results.runs[1].checks[0]);
  BOOST_TEST(contains(words, "modes 1 (nearest +10\u202f%), 2 (nearest +20\u202f%), 3"), words);
  BOOST_TEST(sample.conclusion(sample.results.runs[1].checks[3]) == "");  // a single variant
}

BOOST_AUTO_TEST_SUITE_END()
