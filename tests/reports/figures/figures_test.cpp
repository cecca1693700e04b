#include "reports/figures/figures.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "reports/figures/gallery.h"
#include "reports/figures/outline.h"
#include "tests/support/reports/markup.h"

BOOST_AUTO_TEST_SUITE(figures)

using namespace trammel::reports;
using trammel::testing::contains, trammel::testing::occurrences;

namespace {

CaseInfo beam() {
  CaseInfo info;
  info.id = "beam";
  info.title = "A beam";
  info.family = "beams";
  info.variants = {{"base", "as it is"}, {"lumped", "lumped mass"}};
  return info;
}

/// Returns a convergence study with the errors 0.1 n^-order for n = 1 to 64 elements, and
/// round-off.
Convergence sweep(int index, double order) {
  Convergence c;
  c.sweep = "elements";
  c.quantity = "frequency_Hz";
  c.index = index;
  for (double n = 1; n <= 64; n *= 2) {
    c.parameter.push_back(n);
    c.values.emplace_back(100.0);
    c.error.emplace_back(0.1 * std::pow(n, -order));
    c.roundoff.emplace_back(1e-15 * n * n);
    c.order.emplace_back(order);
    c.gci.emplace_back(0.1);
    c.in_asymptotic_range.push_back(n > 2);
  }
  c.exact = 100;
  c.theory_order = 4;
  c.fitted_order = order;
  return c;
}

Run run_with(std::vector<Convergence> sweeps) {
  Run run;
  run.case_id = "beam";
  run.variant = "base";
  run.status = Status::solved;
  run.convergence = std::move(sweeps);
  return run;
}

Check judged(const std::string& name, double difference, double tolerance) {
  Check check;
  check.name = name;
  check.quantity = "frequency_Hz";
  check.role = "verification";
  check.measure = "relative";
  check.index = 0;
  check.computed = 1 + difference;
  check.expected = 1;
  check.difference = difference;
  check.tolerance = Tolerance{-tolerance, tolerance, true};
  check.verdict = std::abs(difference) <= tolerance ? Verdict::pass : Verdict::fail;
  return check;
}

}  // namespace

BOOST_AUTO_TEST_CASE(convergence_caption_compares_fit_and_theory) {
  const auto good = convergence_figures(beam(), run_with({sweep(0, 3.98), sweep(1, 4.01)}));
  BOOST_TEST_REQUIRE(good.size() == 1U);
  BOOST_TEST(contains(good[0].caption, "2 of 2 curves fall with order 3.98 to 4.01; theory: 4."));
  BOOST_TEST(good[0].data.rows.size() == 14U);
  const auto alone = convergence_figures(beam(), run_with({sweep(0, 2.1)}));
  BOOST_TEST(contains(alone[0].caption, "The error falls with order 2.10; theory: 4."));
}

BOOST_AUTO_TEST_CASE(caption_of_two_orders_names_their_law) {
  Convergence mixed = sweep(0, 4);
  mixed.fitted_order.reset();
  mixed.lower_order = 1.354;
  mixed.two_term = TwoTermLaw{{}, 0.042, {}};
  const auto figure = convergence_figures(beam(), run_with({mixed}));
  BOOST_TEST(contains(figure[0].caption, "the law a h^4 + b h^1.35, with the mesh or step size h"));
  BOOST_TEST(contains(figure[0].caption, "within 4.2\u202f%"));
}

BOOST_AUTO_TEST_CASE(no_order_is_stated_outside_the_asymptotic_range) {
  Convergence coarse = sweep(0, 4);
  coarse.fitted_order.reset();
  const auto figure = convergence_figures(beam(), run_with({coarse}));
  BOOST_TEST(contains(figure[0].caption, "Too few refinement levels lie in the asymptotic range"));
  coarse.in_asymptotic_range.assign(coarse.in_asymptotic_range.size(), false);
  const auto none = convergence_figures(beam(), run_with({coarse}));
  BOOST_TEST(contains(none[0].caption, "No refinement level lies in the asymptotic range"));
}

BOOST_AUTO_TEST_CASE(caption_states_small_numbers_in_their_unit) {
  Run run = run_with({});
  run.quantities = {{"time_s", {{0.0, 1.0}, {}}}, {"position_error_m", {{1e-12, 5.72e-9}, {}}}};
  std::string problem;
  const auto figure = curves_figure(
      beam(), {"f", "f", "time_s", "", {"position_error_m"}, {"base"}}, {&run}, problem);
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST(contains(figure->caption, "Largest magnitude: 5.72\u202f×\u202f10⁻⁹\u202fm."),
             figure->caption);
}

BOOST_AUTO_TEST_CASE(zero_error_on_every_mesh_has_no_convergence_figure) {
  Convergence count = sweep(0, 4);
  for (Number& error : count.error) error = 0;
  BOOST_TEST(convergence_figures(beam(), run_with({count})).empty());
}

BOOST_AUTO_TEST_CASE(tolerance_caption_names_the_worst_check) {
  Run run = run_with({});
  run.checks = {judged("far", 1e-6, 1e-3), judged("near", -9e-4, 1e-3), judged("code", 1, 1)};
  run.checks.back().quantity = "status";  // a status number, not a measurement
  auto figure = tolerance_figure("beams", {{"beam", "A beam"}}, {&run});
  BOOST_TEST_REQUIRE(figure.has_value());
  BOOST_TEST(contains(figure->caption, "All 2 numbers pass"));
  BOOST_TEST(contains(figure->caption, "uses 90\u202f% of its tolerance (near)"));
  run.checks.push_back(judged("beyond", 2e-3, 1e-3));
  figure = tolerance_figure("beams", {{"beam", "A beam"}}, {&run});
  BOOST_TEST(contains(figure->caption,
                      "1 of 3 numbers fail or could not be evaluated; the worst is in beyond."));
}

BOOST_AUTO_TEST_CASE(undrawable_curves_report_the_reason) {
  Run run = run_with({});
  run.quantities["time_s"].values = {0.0, 1.0};
  run.quantities["force_N:A"].values = {1.0, 2.0};
  run.quantities["length_m:A"].values = {1.0};
  const auto problem_of = [&](const std::vector<std::string>& y) {
    std::string problem;
    const PlotRequest request{"f", "f", "time_s", "", y, {"base"}};
    BOOST_TEST(!curves_figure(beam(), request, {&run}, problem).has_value());
    return problem;
  };
  BOOST_TEST(contains(problem_of({"length_m:A"}), "differ in length"));
  BOOST_TEST(contains(problem_of({"torque_N_m:A"}), "has no torque_N_m:A"));
  run.quantities["length_m:B"].values = {1.0, 2.0};
  BOOST_TEST(contains(problem_of({"force_N:A", "length_m:B"}), "differ in unit"));
}

BOOST_AUTO_TEST_CASE(magnified_motion_states_its_largest_deflection) {
  Run run = run_with({});
  run.drawing = Drawing{{{0, 0}, {1, 0}}, {{0, 1}}, {}, {}, {}, {}, {}};
  BOOST_TEST(!motion_figure(beam(), run));
  run.drawing->poses = {{"0 s", {{0, 0}, {1, 0}}, 0.0, {{0, 0}, {0, 0}}},
                        {"1 s", {{0, 0}, {0.9, 0.3}}, 1.0, {{0, 0}, {0, 0.0011}}},
                        {"2 s", {{0, 0}, {0.8, 0.6}}, 2.0, {{0, 0}, {0, -0.0005}}}};
  const auto figure = motion_figure(beam(), run);
  BOOST_REQUIRE(figure);
  BOOST_TEST(contains(figure->caption, "deflections are magnified 110 times."), figure->caption);
  BOOST_TEST(contains(figure->caption, "largest deflection is 1.1\u202fmm, at 1\u202fs."));
  BOOST_TEST(contains(figure->caption, "3 instants up to 2\u202fs"), figure->caption);
  const auto moving = nlohmann::json::parse(figure->moving);
  BOOST_TEST(moving["times"] == nlohmann::json({0.0, 1.0, 2.0}));
  // Checks the displacement of the free end between two instants, with y downwards.
  const auto step = [&](const char* set, std::size_t k, double x, double y) {
    const double unit = 5000 / 1.08;
    BOOST_TEST(std::abs(moving[set][k][2].get<double>() - unit * x) <= 1);
    BOOST_TEST(std::abs(moving[set][k][3].get<double>() + unit * y) <= 1);
  };
  step("still", 1, -0.1, 0.3);
  step("still", 2, -0.1, 0.3);
  step("moved", 1, -0.1, 0.3 + 0.121);
  step("moved", 2, -0.1, 0.3 - 0.121 - 0.055);
  run.drawing->poses[1].displacement[1].second = std::nan("");
  BOOST_TEST(contains(motion_figure(beam(), run)->caption, "2 instants"));
}

BOOST_AUTO_TEST_CASE(rigid_motion_is_drawn_at_few_instants) {
  Run run = run_with({});
  run.drawing = Drawing{{{0, 0}, {1, 0}}, {{0, 1}}, {}, {}, {}, {}, {}};
  for (int k = 0; k <= 20; ++k)
    run.drawing->poses.push_back(
        {"", {{0, 0}, {std::cos(0.1 * k), std::sin(0.1 * k)}}, 0.5 * k, {}});
  run.drawing->poses.push_back(run.drawing->poses.back());  // the last instant occurs twice
  const auto figure = motion_figure(beam(), run);
  BOOST_REQUIRE(figure);
  BOOST_TEST(contains(figure->caption, "Instants: 0, 2.5, 5, 7.5, 10\u202fs"), figure->caption);
  BOOST_TEST(contains(figure->caption, "21 instants up to 10\u202fs"), figure->caption);
  BOOST_TEST(figure->data.rows.size() == 42U);
  BOOST_TEST(!contains(figure->moving, "still"));
}

BOOST_AUTO_TEST_CASE(caption_of_shapes_compares_frequencies) {
  Run run = run_with({});
  run.quantities["frequency_Hz"].values = {0.0, 10.0, 19.6, 20.0};
  run.drawing = Drawing{{{0, 0}, {1, 0}}, {{0, 1}}, {}, {}, {}, {}, {}};
  for (const char* label : {"mode 1, 0 Hz", "mode 2, 10 Hz", "mode 3, 19.6 Hz", "mode 4, 20 Hz"})
    run.drawing->shapes.push_back({label, {{0, 0}, {0, 1}}});
  BOOST_TEST(contains(shapes_figure(beam(), run)->caption,
                      "1 mode is a rigid-body mode. Modes 2 to 4 have 10\u202fHz to 20\u202fHz."),
             shapes_figure(beam(), run)->caption);
  const std::string svg = shapes_figure(beam(), run)->svg;
  BOOST_TEST(contains(svg, "-1-links 1s"), svg);  // mode 2, 0.5 Hz
  BOOST_TEST(contains(svg, "-3-links 0.5s"));
  BOOST_TEST(!contains(svg, "-0-links"));
  run.drawing->shapes.resize(1);
  run.drawing->shapes[0].label = "mode 1, 1.4e+04 times the loads";
  const auto buckled = shapes_figure(beam(), run);
  BOOST_TEST(contains(buckled->caption, "The lowest buckling mode is at 1.4e+04 times the loads."));
  BOOST_TEST(contains(buckled->svg, "mode 1, 1.4\u202f×\u202f10⁴ times the loads"));
  run.drawing->shapes = {{"in phase", {{0, 0}, {0, 0}}}, {"behind", {{0, 0}, {0, -0.001}}}};
  BOOST_TEST(contains(shapes_figure(beam(), run)->caption,
                      "largest displacement is 1\u202fmm (behind), magnified 130 times."),
             shapes_figure(beam(), run)->caption);
}

BOOST_AUTO_TEST_CASE(geometry_has_one_dimension_line_for_each_length) {
  Run run = run_with({});
  run.drawing =
      Drawing{{{0, 0}, {1, 0}, {1, 1}, {1.5, 1}}, {{0, 1}, {1, 2}, {2, 3}}, {}, {}, {}, {}, {}};
  const std::string commands = mechanism_figure(beam(), run)->commands;
  for (const char* length : {"1\u202fm'", "0.5\u202fm'"})
    BOOST_TEST(occurrences(commands, length) == 1U, commands);
  BOOST_TEST(occurrences(commands, "vectors heads") == 2U, commands);
}

BOOST_AUTO_TEST_CASE(history_caption_states_work_and_time) {
  History history;
  const auto call = [&](const char* machine, double cpu_s, std::size_t work, std::size_t failures) {
    const auto number = static_cast<std::int64_t>(history.calls.size() + 1);
    history.calls.push_back({number, "2026-11-23", "c", machine, 1, 2, failures, work, cpu_s});
  };
  call("another", 900, 10, 0);
  call("this", 100, 12, 0);
  call("this", 0, 15, 1);  // some runs are stored ones
  call("this", 150, 20, 0);
  const Figure figure = call_history_figure(history);
  BOOST_TEST(
      contains(figure.caption, "The newest call has 2 times the work and 1.5 times the time."),
      figure.caption);
  BOOST_TEST(contains(figure.commands, "EOD\n1 1\n2 1.2\n3 1.5\n4 2\nEOD"), figure.commands);
  BOOST_TEST(contains(figure.commands, "EOD\n2 1\n4 1.5\nEOD"), figure.commands);
  BOOST_TEST(contains(figure.commands, "EOD\n3 1.5\nEOD"), figure.commands);
  BOOST_TEST(figure.data.rows.size() == 4U);
  history.calls.resize(1);
  BOOST_TEST(
      contains(call_history_figure(history).caption, "The newest call has 1 times the work."));
}

BOOST_AUTO_TEST_CASE(straight_polyline_is_reduced_to_its_end_points) {
  const std::vector<std::vector<int>> line = {{0, 1, 2, 3}};
  BOOST_TEST(polyline_points(line, {{0, 0}, {1, 0}, {2, 0}, {3, 0}}).size() == 2U);
  BOOST_TEST(polyline_points(line, {{0, 0}, {1, 0}, {2, 0}, {2, 1}}).size() == 3U);
}

BOOST_AUTO_TEST_CASE(members_join_to_polylines_and_meshes_to_outlines) {
  Drawing drawing;
  drawing.members = {{0, 1}, {1, 2}, {5, 6}};
  BOOST_TEST(polylines(drawing).size() == 2U);
  const int n = 5;  // a square of 5 x 5 cells without the middle cell, two triangles each
  std::vector<Point> nodes;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) nodes.emplace_back(j, i);
  drawing.nodes = nodes;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      if (i == 2 && j == 2) continue;
      const int a = i * (n + 1) + j;
      drawing.triangles.push_back({a, a + 1, a + n + 1});
      drawing.triangles.push_back({a + 1, a + n + 1, a + n + 2});  // clockwise
    }
  const auto loops = triangle_edges(drawing);
  BOOST_REQUIRE(loops.size() == 2U);
  for (const auto& loop : loops) BOOST_TEST(loop.front() == loop.back());
  BOOST_TEST(loops[0].size() + loops[1].size() == 4U * n + 1 + 5);
  // The filled area is one polygon: 4 + 1 corners of the square, 4 + 1 of the hole, and the start.
  BOOST_TEST(filled_triangles(drawing, nodes).size() == 11U);
  BOOST_TEST(triangle_edges_inside(drawing).size() == (3U * 48 - 24) / 2);
  BOOST_TEST(triangle_edges_inside(drawing, 20).empty());
}

BOOST_AUTO_TEST_SUITE_END()
