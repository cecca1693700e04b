#include "references/numerics/expression.h"

#include <boost/test/unit_test.hpp>
#include <string>

BOOST_AUTO_TEST_SUITE(expression)

using namespace trammel::references;

namespace {

double value(const std::string& text) {
  return static_cast<double>(evaluate_expression(text, {{"a", Real(3)}, {"b_1", Real("0.1")}}));
}

}  // namespace

BOOST_AUTO_TEST_CASE(operators_have_the_usual_precedence) {
  BOOST_TEST(value("1 + 2*a^2/6 - -1") == 5.0);
  BOOST_TEST(value("2^3^2") == 512.0);
  BOOST_TEST(value("-a^2") == -9.0);
  BOOST_TEST(value("(1-4)*(2+a)") == -15.0);
  BOOST_TEST(value("8/2/2") == 2.0);
}

BOOST_AUTO_TEST_CASE(decimal_numbers_are_read_beyond_a_double) {
  BOOST_TEST(static_cast<double>(evaluate_expression("0.1 - b_1", {{"b_1", Real("0.1")}})) == 0.0);
  BOOST_TEST(value("1.5e-3*1e3") == 1.5);
  BOOST_TEST(value("sqrt(2)^2 - 2 + sin(pi)") == 0.0, boost::test_tools::tolerance(1e-45));
}

BOOST_AUTO_TEST_CASE(invalid_expression_is_refused) {
  for (const char* text : {"1 +", "2 a", "(1", "sin 1", "unknown", "1/0", "", "sqrt(-1)", "1..2"})
    BOOST_CHECK_THROW(static_cast<void>(value(text)), DerivationError);
}

BOOST_AUTO_TEST_SUITE_END()
