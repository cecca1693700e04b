#include <boost/test/unit_test.hpp>
#include <limits>

#include "harness/judge/input_uncertainty.h"

BOOST_AUTO_TEST_SUITE(validation_verdict)

using namespace trammel;
using namespace trammel::harness;
using results::Comparison;

namespace {

Comparison comparison(double simulation, double expected, double u_num, double u_input,
                      double u_reference) {
  Comparison c;
  c.unit = "Hz";
  c.simulation = simulation;
  c.expected = expected;
  c.u_num = u_num;
  c.u_input = c.all_inputs.u_input = u_input;
  c.u_reference = u_reference;
  return c;
}

std::vector<Comparison> judged(std::vector<Comparison> row) {
  evaluate_validation_row(row);
  return row;
}

}  // namespace

BOOST_AUTO_TEST_CASE(half_width_is_twice_root_sum_square_of_uncertainties) {
  const auto v = judged({comparison(17.0, 10.0, 2.0, 3.0, 6.0)}).front();
  BOOST_TEST(*v.difference == 7.0);
  BOOST_TEST(*v.u_val == 7.0);
  BOOST_TEST(*v.interval[0] == -7.0);
  BOOST_TEST(*v.interval[1] == 21.0);
  BOOST_TEST(v.verdict == kWithinUncertainty);
  BOOST_TEST(v.conclusion ==
             "the difference of 7 Hz is within the validation uncertainty of ±14 Hz");
}

BOOST_AUTO_TEST_CASE(difference_beyond_uncertainty_is_reported_as_a_range) {
  const auto v = judged({comparison(10.0, 12.0, 0.0, 0.25, 0.0)}).front();
  BOOST_TEST(v.verdict == kModelError);
  BOOST_TEST(v.conclusion == "model error between 1.5 and 2.5 Hz, too low");
}

BOOST_AUTO_TEST_CASE(unequal_references_of_equal_values_are_inconsistent) {
  const Comparison first = comparison(14.0, 12.768, 0, 0.1, 3e-4);
  const Comparison second = comparison(14.0, 15.115, 0, 0.1, 3e-4);
  const auto row = judged({first, second});
  BOOST_TEST(row[0].verdict == kReferenceInconsistent);
  BOOST_TEST(row[1].verdict == kReferenceInconsistent);
  BOOST_TEST(row[0].conclusion.find("12.768 to 15.115 Hz") != std::string::npos);
  BOOST_TEST(*row[0].difference == 14.0 - 12.768);
}

BOOST_AUTO_TEST_CASE(value_outside_inconsistent_references_is_model_error) {
  const Comparison first = comparison(20.0, 12.768, 0, 0.1, 3e-4);
  const Comparison second = comparison(20.0, 15.115, 0, 0.1, 3e-4);
  for (const auto& v : judged({first, second})) BOOST_TEST(v.verdict == kModelError);
}

BOOST_AUTO_TEST_CASE(unequal_computed_values_are_not_treated_as_a_pair) {
  const Comparison first = comparison(14.0, 12.768, 0, 0.1, 3e-4);
  const Comparison second = comparison(14.1, 15.115, 0, 0.1, 3e-4);
  for (const auto& v : judged({first, second})) BOOST_TEST(v.verdict == kModelError);
}

BOOST_AUTO_TEST_CASE(pair_printed_with_few_digits_is_judged_separately) {
  const Comparison first = comparison(14.06, 13.0, 0, 0.1, 0.29);
  const Comparison second = comparison(14.06, 13.5, 0, 0.1, 0.29);
  const auto row = judged({first, second});
  BOOST_TEST(row[0].verdict == kModelError);
  BOOST_TEST(row[1].verdict == kWithinUncertainty);
}

BOOST_AUTO_TEST_CASE(missing_number_leaves_the_verdict_undecided) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  for (const Comparison& c : {comparison(missing, 1, 0, 0, 0), comparison(1, 1, missing, 0, 0),
                              comparison(1, 1, 0, missing, 0)}) {
    const auto v = judged({c}).front();
    BOOST_TEST(v.verdict == "undecided");
  }
}

BOOST_AUTO_TEST_SUITE_END()
