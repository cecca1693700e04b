#include "reports/text/quantity.h"

#include <boost/test/unit_test.hpp>

BOOST_AUTO_TEST_SUITE(quantity)

using namespace trammel::reports;

BOOST_AUTO_TEST_CASE(quantity_name_is_split_into_label_subject_and_unit) {
  const QuantityLabel moment = parse_quantity("reaction_moment_N_m:A1");
  BOOST_TEST(moment.label == "reaction moment");
  BOOST_TEST(moment.subject == "A1");
  BOOST_TEST(moment.unit == "N·m");
  BOOST_TEST(to_text(parse_quantity("displacement_x_m:P")) == "x displacement of P");
  BOOST_TEST(to_text(parse_quantity("frequency_Hz:1")) == "frequency of mode 1");
  BOOST_TEST(to_text(parse_quantity("relative_error:displacement_y_m:B")) ==
             "relative error of y displacement of B");
  BOOST_TEST(parse_quantity("relative_error:frequency_Hz").unit == "");
  BOOST_TEST(to_text(parse_quantity("peak_time_s:displacement_y_m:M")) ==
             "peak time of y displacement of M");
  BOOST_TEST(to_text(parse_quantity("relative_error:serial_distance")) ==
             "relative error of serial distance");
  BOOST_TEST(to_text(parse_quantity("displacement_x_m:tip_left")) == "x displacement of tip_left");
  BOOST_TEST(parse_quantity("platform_inertia_kg_m2").unit == "kg·m²");
  BOOST_TEST(parse_quantity("frequency_roundoff").unit == "");
}

BOOST_AUTO_TEST_CASE(formulas_become_mathml) {
  BOOST_TEST(math_html("(k r)^2 / pi") ==
             "<math><mo>(</mo><mi>k</mi><mi>r</mi><msup><mo>)</mo><mn>2</mn></msup><mo>/</mo>"
             "<mi>π</mi></math>");
  BOOST_TEST(math_html("spring^2") ==
             "<math><msup><mtext>&#160;spring&#160;</mtext><mn>2</mn></msup></math>");
}

BOOST_AUTO_TEST_CASE(units_are_written_as_in_print) {
  BOOST_TEST(display_unit("N m") == "N·m");
  BOOST_TEST(display_unit("kg m^2") == "kg·m²");
  BOOST_TEST(display_unit("1") == "");
}

BOOST_AUTO_TEST_CASE(values_are_scaled_to_readable_units) {
  BOOST_TEST(readable_scale("m", 0.0081).unit == "mm");
  BOOST_TEST(readable_scale("m", 0.0081).factor == 1000);
  BOOST_TEST(readable_scale("m", 0.43).unit == "m");
  BOOST_TEST(readable_scale("Pa", 3.1e7).unit == "MPa");
  BOOST_TEST(readable_scale("N", 3.3).unit == "N");
  BOOST_TEST(readable_scale("", 3e-9).unit == "10⁻⁹");
  BOOST_TEST(readable_scale("rad", 0).factor == 1);
}

BOOST_AUTO_TEST_SUITE_END()
