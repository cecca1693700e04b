#include <boost/test/unit_test.hpp>

#include "reports/drawing/palette.h"
#include "reports/figures/figures.h"
#include "tests/support/reports/markup.h"

BOOST_AUTO_TEST_SUITE(map)

using namespace trammel::reports;
using trammel::testing::contains;

namespace {

CaseInfo workspace() {
  CaseInfo info;
  info.id = "workspace";
  info.title = "A workspace";
  return info;
}

/// Returns a field x + 10 y at columns x rows positions, 0.1 m apart.
Run field(int columns, int rows) {
  std::vector<double> x, y, value;
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < columns; ++i) {
      x.emplace_back(0.1 * i);
      y.emplace_back(0.1 * j);
      value.emplace_back(0.1 * i + 1.0 * j);
    }
  Run run;
  run.case_id = "workspace";
  run.variant = "base";
  run.status = Status::solved;
  run.quantities = {
      {"position_x_m", {x, {}}}, {"position_y_m", {y, {}}}, {"frequency_Hz", {value, {}}}};
  return run;
}

PlotRequest request(const char* id, const std::string& value) {
  PlotRequest made;
  made.id = made.title = id;
  made.x = "position_x_m";
  made.y = {"position_y_m"};
  made.value = value;
  return made;
}

std::optional<Figure> draw(const Run& run, std::string& problem) {
  return map_figure(workspace(), request("map", "frequency_Hz"), {&run}, problem);
}

}  // namespace

BOOST_AUTO_TEST_CASE(map_keeps_every_position_and_explains_its_colors) {
  std::string problem;
  const auto figure = draw(field(14, 5), problem);
  BOOST_TEST_REQUIRE(figure.has_value(), problem);
  BOOST_TEST(figure->data.rows.size() == 70U);
  BOOST_TEST(
      contains(figure->caption,
               " in Hz; values far from zero are dark. Each color covers about the same number of "
               "positions."));
  BOOST_TEST(contains(figure->commands, "'below 1'"));  // each class has ten values
  BOOST_TEST(contains(figure->alt, "The largest magnitude is 5.3 Hz"));
}

BOOST_AUTO_TEST_CASE(large_magnitudes_are_dark_for_either_sign) {
  std::string problem;
  Run run = field(14, 5);
  const auto shade_of_lowest = [&] {
    const auto figure = draw(run, problem);
    BOOST_TEST_REQUIRE(figure.has_value(), problem);
    const std::size_t key = figure->commands.find("'below ");
    const std::size_t color = figure->commands.rfind('#', key);
    return figure->commands.substr(color, 7);
  };
  BOOST_TEST(shade_of_lowest() == palette::kSequence.front());
  for (double& number : run.quantities["frequency_Hz"].values) number = -number;
  BOOST_TEST(shade_of_lowest() == palette::kSequence.back());
  run.quantities["frequency_Hz"].values[0] = 7.0;
  BOOST_TEST(shade_of_lowest() == palette::kSequence.front());
  BOOST_TEST(contains(draw(run, problem)->caption, "high values are dark"));
}

BOOST_AUTO_TEST_CASE(maps_of_one_quantity_have_one_scale) {
  Run run = field(14, 5);
  std::vector<double>& hot = run.quantities["frequency_Hz:hot"].values;
  hot = run.quantities["frequency_Hz:cold"].values = run.quantities["frequency_Hz"].values;
  run.quantities.erase("frequency_Hz");
  for (double& number : hot) number += 100;
  CaseInfo info = workspace();
  for (const char* name : {"cold", "hot"})
    info.figures.push_back(request(name, std::string("frequency_Hz:") + name));
  std::string problem;
  const auto cold = map_figure(info, info.figures[0], {&run}, problem);
  const auto high = map_figure(info, info.figures[1], {&run}, problem);
  BOOST_TEST_REQUIRE((cold && high), problem);
  BOOST_TEST(contains(cold->caption, "All maps of this quantity have the same color scale"));
  BOOST_TEST(contains(cold->commands, "'below "));
  BOOST_TEST(!contains(cold->commands, "'above "));
  BOOST_TEST(contains(high->commands, "'above "));
  BOOST_TEST(!contains(high->commands, "'below "));
}

BOOST_AUTO_TEST_CASE(positions_without_a_number_stay_blank) {
  Run run = field(14, 5);
  run.quantities["frequency_Hz"].values[3] = std::nan("");
  std::string problem;
  const auto figure = draw(run, problem);
  BOOST_TEST_REQUIRE(figure.has_value(), problem);
  BOOST_TEST(figure->data.rows.size() == 69U);
  for (double& number : run.quantities["frequency_Hz"].values) number = std::nan("");
  BOOST_TEST(!draw(run, problem).has_value());
  BOOST_TEST(problem == "frequency_Hz has no numbers");
}

BOOST_AUTO_TEST_CASE(map_of_one_row_or_column_has_valid_cells_and_tics) {
  // Gnuplot refuses a distance of 0 between the tick marks of a map. The program once failed to
  // write a report with such a map.
  std::string problem;
  for (const auto& [columns, rows] : {std::pair{1, 6}, std::pair{6, 1}}) {
    const auto figure = draw(field(columns, rows), problem);
    BOOST_TEST_REQUIRE(figure.has_value(), problem);
    BOOST_TEST(!contains(figure->commands, "set xtics 0\n"));
    BOOST_TEST(!contains(figure->commands, "nan"));
    BOOST_TEST(contains(figure->commands, "-0.05 0.05"));  // the first cell is 0.1 m wide about 0
  }
}

BOOST_AUTO_TEST_CASE(single_position_has_no_map) {
  std::string problem;
  BOOST_TEST(!draw(field(1, 1), problem).has_value());
  BOOST_TEST(problem == "frequency_Hz has a single position");
}

BOOST_AUTO_TEST_SUITE_END()
