#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "solver/linear/free_motions.h"
#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(zero_energy_modes)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

std::string words(const Model& model) {
  const StaticSolution solution = solve_statics(assemble(model));
  BOOST_TEST((solution.outcome.status == Status::singular));
  BOOST_TEST(solution.displacement.size() == 0);  // a singular model has no displacements
  BOOST_TEST(solution.reaction.size() == 0);
  return solution.outcome.reason;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(beam_without_supports_has_three_free_motions) {
  const std::string text = words(beam(unit_section(), 1, 4));
  BOOST_TEST(std::ranges::count(text, ';') == 2, text);  // two separators: three motions
  BOOST_TEST(contains(text, "free motion: node A along x 1, node B along x 1"), text);
}

BOOST_AUTO_TEST_CASE(three_largest_entries_of_a_motion_are_named) {
  const Section bar = unit_section();
  for (const bool stretches : {true, false}) {
    Model model;
    model.nodes = {{"A", {0, 0}}, {"B", {0, 1}}, {"C", {2, 1}}, {"D", {2, 0}}};
    model.members = {hinged("crank", 0, 1, bar), hinged("coupler", 1, 2, bar),
                     hinged("rocker", 2, 3, bar)};
    for (Member& m : model.members) m.axially_flexible = stretches;
    model.supports = {pin(0), pin(3)};
    BOOST_TEST(words(model) ==
               "free motion: rotation of the start of member crank 1, rotation of the end of "
               "member crank 1, rotation of the start of member rocker 1");
  }
}

BOOST_AUTO_TEST_CASE(free_motion_does_not_depend_on_the_angle) {
  for (const double angle : {0.0, 0.3, 2.0}) {
    Model model = beam(unit_section(), 1, 4, angle);
    model.supports = {clamp(0)};
    model.members[0].ends[0].fixity = EndFixity::hinged;
    BOOST_TEST(contains(words(model), "rotation of node B 1"), words(model));
  }
}

BOOST_AUTO_TEST_CASE(at_most_six_motions_are_described) {
  Model model = cantilever(unit_section(), 1, 2);
  model.nodes.push_back({"lost", {3, 3}});
  const std::string text = words(model);
  BOOST_TEST(contains(text, "free motion: node lost along x 1"));
  BOOST_TEST(contains(text, "free motion: node lost along y 1"));
  for (const double x : {4, 5, 6}) model.nodes.push_back({"lost too", {x, 3}});
  BOOST_TEST(contains(words(model), "; and 2 more"));
}

BOOST_AUTO_TEST_CASE(soft_spring_holds_a_stiff_beam) {
  Model model = beam(unit_section(1e10), 1, 4, 0.4);
  model.supports = {pin(0)};
  model.springs = {{"soft", {1, -1}, {0, 1e-6, 0}}};
  const StaticSolution solution = solve_statics(assemble(model));
  BOOST_TEST(solution.outcome.solved(), solution.outcome.reason);
}

BOOST_AUTO_TEST_CASE(free_massless_part_has_no_modes) {
  Model model = cantilever(unit_section(), 1, 2);
  model.nodes.push_back({"lost", {3, 3}});
  const ModalSolution modes = solve_modes(assemble(model), {});
  BOOST_TEST((modes.outcome.status == Status::singular));
  BOOST_TEST(contains(modes.outcome.reason, "free motion: node lost"));
  BOOST_TEST(modes.frequency.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
