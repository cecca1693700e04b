#include "harness/judge/validation_verdict.h"

#include <boost/test/unit_test.hpp>
#include <limits>

BOOST_AUTO_TEST_SUITE(validation_verdict)

using namespace trammel;
using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(uncertainties_add_in_quadrature_and_count_twice) {
  const auto v = evaluate_validation_row({{17.0, 10.0, 2.0, 3.0, 6.0}}, "Hz").front();
  BOOST_TEST(v.difference == 7.0);
  BOOST_TEST(v.u_val == 7.0);
  BOOST_TEST(v.low == -7.0);
  BOOST_TEST(v.high == 21.0);
  BOOST_TEST((v.verdict == ValidationVerdict::within_validation_uncertainty));
  BOOST_TEST(v.text == "the difference of 7 Hz is within the validation uncertainty of ±14 Hz");
}

BOOST_AUTO_TEST_CASE(a_difference_beyond_the_noise_is_given_as_a_range) {
  const auto v = evaluate_validation_row({{10.0, 12.0, 0.0, 0.25, 0.0}}, "Hz").front();
  BOOST_TEST((v.verdict == ValidationVerdict::beyond_validation_uncertainty));
  BOOST_TEST(v.text == "model error between 1.5 and 2.5 Hz, too low");
}

BOOST_AUTO_TEST_CASE(a_reference_that_splits_a_repeated_value_contradicts_itself) {
  const Comparison first{14.0, 12.768, 0, 0.1, 3e-4};
  const Comparison second{14.0, 15.115, 0, 0.1, 3e-4};
  const auto row = evaluate_validation_row({first, second}, "Hz");
  BOOST_TEST((row[0].verdict == ValidationVerdict::reference_inconsistent));
  BOOST_TEST((row[1].verdict == ValidationVerdict::reference_inconsistent));
  BOOST_TEST(row[0].text.find("12.768 to 15.115 Hz") != std::string::npos);
  BOOST_TEST(row[0].difference == 14.0 - 12.768);
}

BOOST_AUTO_TEST_CASE(a_contradiction_is_no_excuse_for_a_model_that_lies_beyond_it) {
  const Comparison first{20.0, 12.768, 0, 0.1, 3e-4};
  const Comparison second{20.0, 15.115, 0, 0.1, 3e-4};
  for (const auto& v : evaluate_validation_row({first, second}, "Hz")) {
    BOOST_TEST((v.verdict == ValidationVerdict::beyond_validation_uncertainty));
  }
}

BOOST_AUTO_TEST_CASE(values_that_differ_by_more_than_round_off_are_not_a_pair) {
  const Comparison first{14.0, 12.768, 0, 0.1, 3e-4};
  const Comparison second{14.1, 15.115, 0, 0.1, 3e-4};
  for (const auto& v : evaluate_validation_row({first, second}, "Hz")) {
    BOOST_TEST((v.verdict == ValidationVerdict::beyond_validation_uncertainty));
  }
}

BOOST_AUTO_TEST_CASE(a_pair_printed_to_few_digits_may_differ_by_them) {
  const Comparison first{14.06, 13.0, 0, 0.1, 0.29};
  const Comparison second{14.06, 13.5, 0, 0.1, 0.29};
  const auto row = evaluate_validation_row({first, second}, "Hz");
  BOOST_TEST((row[0].verdict == ValidationVerdict::beyond_validation_uncertainty));
  BOOST_TEST((row[1].verdict == ValidationVerdict::within_validation_uncertainty));
}

BOOST_AUTO_TEST_CASE(nothing_is_claimed_where_a_number_is_missing) {
  const double missing = std::numeric_limits<double>::quiet_NaN();
  for (const Comparison& c : {Comparison{missing, 1, 0, 0, 0}, Comparison{1, 1, missing, 0, 0},
                              Comparison{1, 1, 0, missing, 0}}) {
    const auto v = evaluate_validation_row({c}, "Hz").front();
    BOOST_TEST((v.verdict == ValidationVerdict::undecided));
    BOOST_TEST(to_string(v.verdict) == "undecided");
  }
}

BOOST_AUTO_TEST_SUITE_END()
