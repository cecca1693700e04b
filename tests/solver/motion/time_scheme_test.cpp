#include "solver/motion/time_scheme.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/model/model.h"

BOOST_AUTO_TEST_SUITE(time_scheme)

using namespace trammel::solver;
using boost::test_tools::tolerance;

BOOST_AUTO_TEST_CASE(generalized_alpha_has_its_spectral_radius) {
  for (const double radius : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    BOOST_TEST(std::abs(spectral_radius(generalized_alpha(radius), 1e5) - radius) < 1e-2);
    BOOST_TEST(spectral_radius(generalized_alpha(radius), 1e-3) == 1, tolerance(1e-8));
  }
}

BOOST_AUTO_TEST_CASE(trapezoidal_rule_has_spectral_radius_1) {
  for (double phase = 1e-3; phase < 1e3; phase *= 1.7)
    BOOST_TEST(spectral_radius(average_acceleration(), phase) == 1, tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(stability_limits_of_time_steps_are_those_of_theory) {
  BOOST_TEST(std::isinf(stability_limit(average_acceleration())));
  BOOST_TEST(std::isinf(stability_limit(hht_alpha(-0.2))));
  BOOST_TEST(std::isinf(stability_limit(generalized_alpha(0.7))));
  BOOST_TEST(std::abs(stability_limit(central_difference()) - 2) < 1e-6);
  BOOST_TEST(std::abs(stability_limit(linear_acceleration()) - std::sqrt(12.0)) < 1e-6);
}

BOOST_AUTO_TEST_CASE(invalid_parameters_are_refused) {
  BOOST_CHECK_THROW(static_cast<void>(generalized_alpha(1.1)), ModelError);
  BOOST_CHECK_THROW(static_cast<void>(generalized_alpha(std::nan(""))), ModelError);
  BOOST_CHECK_THROW(static_cast<void>(hht_alpha(0.1)), ModelError);
  BOOST_CHECK_THROW(static_cast<void>(newmark(-0.1, 0.5)), ModelError);
  BOOST_CHECK_THROW(static_cast<void>(newmark(0.25, 0.4)), ModelError);
}

BOOST_AUTO_TEST_SUITE_END()
