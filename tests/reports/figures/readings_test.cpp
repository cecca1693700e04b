#include "reports/figures/readings.h"

#include <boost/test/unit_test.hpp>

#include "tests/support/reports/markup.h"

BOOST_AUTO_TEST_SUITE(readings)

using namespace trammel;
using namespace trammel::reports;
using trammel::testing::contains;

namespace {

results::RowProbabilities row(double discrepancy, double off) {
  results::RowProbabilities out;
  out.row = "ansys";
  out.unit = "Hz";
  out.discrepancy = discrepancy;
  out.entropy_bits = 1.5;
  out.printed = {10.0, 20.0};
  out.leading = {{"hinged elbows", 1, 0.75, {10.1, 20 * (1 + off)}}, {"welded", 2, 0.25, {9, {}}}};
  out.further_numbers = {{"frequency 7", 0.5}};
  return out;
}

std::vector<Figure> figures_of(const std::vector<results::RowProbabilities>& rows) {
  CaseInfo info;
  info.id = "models";
  Run run;
  run.model_probabilities = results::ModelProbabilities{rows, {}};
  const Run other;
  return reading_figures(info, {&other, &run});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_row_is_drawn_once_under_its_middle_discrepancy) {
  const std::vector<Figure> figures =
      figures_of({row(0.001, 0.02), row(0.01, 0.02), row(0.1, 0.02)});
  BOOST_TEST_REQUIRE(figures.size() == 1U);
  const std::string& caption = figures[0].caption;
  BOOST_TEST(contains(caption, "discrepancy of 1"), caption);
  BOOST_TEST(contains(caption, "hinged elbows, with 75"), caption);
  BOOST_TEST(contains(caption, "off by up to 2\u202f%, as such a discrepancy allows"), caption);
  BOOST_TEST(contains(caption, "frequency 7 would tell most"), caption);
  BOOST_TEST(figures[0].data.rows.size() == 4U);
}

BOOST_AUTO_TEST_CASE(a_row_that_no_reading_explains_says_so) {
  const std::string caption = figures_of({row(0.01, 0.04)}).at(0).caption;
  BOOST_TEST(contains(caption, "no reading explains the row"), caption);
}

BOOST_AUTO_TEST_CASE(without_probabilities_there_is_no_figure) {
  const Run run;
  BOOST_TEST(reading_figures({}, {&run}).empty());
}

BOOST_AUTO_TEST_SUITE_END()
