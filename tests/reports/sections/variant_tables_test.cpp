#include <boost/test/unit_test.hpp>

#include "reports/sections/sections.h"

BOOST_AUTO_TEST_SUITE(variant_tables)

using namespace trammel::reports;

namespace {

std::string cell(const std::string& quantity, const std::string& statistic) {
  Run run;
  run.variant = "base";
  run.quantities["frequency_Hz"].values = {3.0, -4.0};
  CaseInfo info;
  info.tables.push_back({"t", "Table", "", {{"c", "Column", quantity, "", "", statistic}}, {}});
  const Data tables = trammel::reports::variant_tables(info, {&run});
  const Data row = tables.list_value().at(0).get("rows")->list_value().at(0);
  return row.get("cells")->list_value().at(0).get("text")->string_value();
}

}  // namespace

BOOST_AUTO_TEST_CASE(column_shows_its_statistic_or_the_first_entry) {
  BOOST_TEST(cell("frequency_Hz", "") == "3");
  BOOST_TEST(cell("frequency_Hz", "first") == "3");
  BOOST_TEST(cell("frequency_Hz", "last") == "\u22124");
  BOOST_TEST(cell("frequency_Hz", "max_abs") == "4");
  BOOST_TEST(cell("frequency_Hz", "rms") == "3.54");
  BOOST_TEST(cell("frequency_Hz", "median") == "\u22120.5");
}

BOOST_AUTO_TEST_CASE(missing_quantity_or_statistic_is_a_dash) {
  BOOST_TEST(cell("mass_kg", "") == "\u2013");
  BOOST_TEST(cell("frequency_Hz", "no such") == "\u2013");
}

BOOST_AUTO_TEST_SUITE_END()
