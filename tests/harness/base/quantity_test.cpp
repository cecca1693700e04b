#include "harness/base/quantity.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(quantity)

using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(unit_is_the_end_of_the_quantity_name) {
  BOOST_TEST(unit_of("frequency_Hz") == "Hz");
  BOOST_TEST(unit_of("displacement_x_m:P") == "m");
  BOOST_TEST(unit_of("reaction_moment_N_m:A1") == "N m");
  BOOST_TEST(unit_of("reaction_x_N:A1") == "N");
  BOOST_TEST(unit_of("end_rotation_rad:A1-B1.start") == "rad");
  BOOST_TEST(unit_of("inertia_kg_m2:total") == "kg m^2");
  BOOST_TEST(split_name("reaction_moment_N_m:A1").name == "reaction_moment");
  BOOST_TEST(split_name("parallel_singularity_distance").name == "parallel_singularity_distance");
  BOOST_TEST(unit_of("stress_Pa:AB") == "Pa");
  BOOST_TEST(unit_of("difference_percent:rows") == "%");
  BOOST_TEST(unit_of("parallel_singularity_distance") == "1");
  BOOST_TEST(unit_of("frequency_roundoff") == "1");
  BOOST_TEST(unit_of("odd:name_m") == "1");
}

BOOST_AUTO_TEST_CASE(diagnostic_quantities_are_recognized) {
  for (const char* name : {"frequency_roundoff", "equilibrium_residual_N", "step_residual:J",
                           "constraint_rate_residual"}) {
    BOOST_TEST(is_error_measure(name), name);
  }
  for (const char* name : {"frequency_Hz", "displacement_error", "compliance_J", "x:roundoff"})
    BOOST_TEST(!is_error_measure(name), name);
}

BOOST_AUTO_TEST_SUITE_END()
