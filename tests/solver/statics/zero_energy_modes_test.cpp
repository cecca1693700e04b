#include "solver/statics/zero_energy_modes.h"

#include <boost/test/unit_test.hpp>

#include "solver/modes/modes.h"
#include "solver/statics/statics.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(zero_energy_modes)

using namespace trammel::solver;
using namespace trammel::testing;

namespace {

std::string words(const Model& model) {
  const StaticSolution solution = solve_statics(assemble(model));
  BOOST_TEST((solution.outcome.status == Status::singular));
  BOOST_TEST(solution.displacement.size() == 0);  // never numbers
  BOOST_TEST(solution.reaction.size() == 0);
  return solution.outcome.reason;
}

Member hinged(const char* name, Index a, Index b) {
  Member m = member(name, a, b, unit_section());
  m.ends[0].fixity = m.ends[1].fixity = EndFixity::hinged;
  return m;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_beam_without_supports_floats) {
  BOOST_TEST(words(beam(unit_section(), 1, 4, 0.3)) ==
             "the whole model moves freely in the plane (along x, along y and in rotation)");
}

BOOST_AUTO_TEST_CASE(a_beam_on_one_pin_turns_about_it) {
  Model model = beam(unit_section(), 1, 4, 0.3);
  model.supports = {pin(0)};
  BOOST_TEST(words(model) == "rotation of the whole model about (0, 0) m");
}

BOOST_AUTO_TEST_CASE(a_beam_on_two_rollers_slides) {
  Model model = beam(unit_section(), 1, 4);
  model.supports = {roller(0), roller(1)};
  BOOST_TEST(words(model) == "the whole model moves freely along x");
}

BOOST_AUTO_TEST_CASE(a_beam_on_one_roller_slides_and_turns) {
  Model model = beam(unit_section(), 1, 4);
  model.supports = {roller(1)};
  BOOST_TEST(words(model) ==
             "rotation of the whole model about (1, 0) m; the whole model moves freely along x");
}

BOOST_AUTO_TEST_CASE(a_hinged_four_bar_is_told_by_its_links) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {0, 1}}, {"C", {2, 1}}, {"D", {2, 0}}};
  model.members = {hinged("crank", 0, 1), hinged("coupler", 1, 2), hinged("rocker", 2, 3)};
  model.supports = {pin(0), pin(3)};
  BOOST_TEST(words(model) ==
             "rotation of member crank about (0, 0) m; member coupler moves freely along x; "
             "rotation of member rocker about (2, 0) m");
}

BOOST_AUTO_TEST_CASE(a_mechanism_of_inextensible_links_is_found_as_well) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {0, 1}}, {"C", {2, 1}}, {"D", {2, 0}}};
  model.members = {hinged("crank", 0, 1), hinged("coupler", 1, 2), hinged("rocker", 2, 3)};
  for (Member& m : model.members) m.axially_flexible = false;
  model.supports = {pin(0), pin(3)};
  BOOST_TEST(contains(words(model), "member coupler moves freely along x"));
}

BOOST_AUTO_TEST_CASE(a_rigid_platform_is_called_by_its_name) {
  Model model;
  model.nodes = {{"P", {0.25, 0.144}}, {"C1", {0.15, 0.1}}, {"C2", {0.35, 0.1}}};
  model.rigid_bodies = {{"platform", 0, {1, 2}}};
  model.supports = {pin(0)};
  model.members = {};
  model.nodes.push_back({"G", {0, 0}});
  model.nodes.push_back({"H", {0, 1}});
  model.members = {member("post", 3, 4, unit_section())};
  model.supports.push_back(clamp(3));
  BOOST_TEST(words(model) == "rotation of the platform about (0.25, 0.144) m");
}

BOOST_AUTO_TEST_CASE(a_node_that_nothing_holds_is_named) {
  Model model = cantilever(unit_section(), 1, 2);
  model.nodes.push_back({"lost", {3, 3}});
  const std::string text = words(model);
  BOOST_TEST(contains(text, "node lost moves freely along x"));
  BOOST_TEST(contains(text, "node lost moves freely along y"));
  for (const double x : {4, 5, 6}) model.nodes.push_back({"lost too", {x, 3}});
  BOOST_TEST(contains(words(model), "; and 2 more"));  // of eight motions six are described
}

BOOST_AUTO_TEST_CASE(a_straight_pair_of_hinged_bars_has_an_infinitesimal_motion) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {1, 0}}, {"C", {2, 0}}};
  model.members = {hinged("left", 0, 1), hinged("right", 1, 2)};
  model.supports = {pin(0), pin(2)};
  BOOST_TEST(contains(words(model), "rotation of member left about (0, 0) m"));
}

BOOST_AUTO_TEST_CASE(two_loose_parts_are_told_one_by_one) {
  Model model = cantilever(unit_section(), 1, 1);
  model.nodes.push_back({"C", {0, 2}});
  model.nodes.push_back({"D", {1, 2}});
  model.nodes.push_back({"E", {0, 4}});
  model.nodes.push_back({"F", {1, 4}});
  model.members.push_back(member("upper", 2, 3, unit_section()));
  model.members.push_back(member("top", 4, 5, unit_section()));
  model.supports.push_back(pin(2));
  model.supports.push_back(pin(5));
  const std::string text = words(model);
  BOOST_TEST(contains(text, "rotation of member upper about (0, 2) m"));
  BOOST_TEST(contains(text, "rotation of member top about (1, 4) m"));
}

BOOST_AUTO_TEST_CASE(a_long_slender_chain_is_ill_conditioned_but_no_mechanism) {
  Model model = cantilever(unit_section(1e8), 1, 1500);
  model.loads = {{1, {0, 1, 0}}};
  const StaticSolution solution = solve_statics(assemble(model));
  BOOST_TEST(solution.outcome.solved(), solution.outcome.reason);
  BOOST_TEST(solution.displacement(1, 1) == 1 / 3.0, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(a_soft_spring_holds_a_stiff_beam) {
  Model model = beam(unit_section(1e10), 1, 4, 0.4);
  model.supports = {pin(0)};
  model.springs = {{"soft", {1, -1}, {0, 1e-6, 0}}};
  const StaticSolution solution = solve_statics(assemble(model));
  BOOST_TEST(solution.outcome.solved(), solution.outcome.reason);
}

BOOST_AUTO_TEST_CASE(a_massless_part_that_moves_freely_has_no_modes) {
  Model model = cantilever(unit_section(), 1, 2);
  model.nodes.push_back({"lost", {3, 3}});
  const ModalSolution modes = solve_modes(assemble(model), {});
  BOOST_TEST((modes.outcome.status == Status::singular));
  BOOST_TEST(contains(modes.outcome.reason, "node lost moves freely"));
  BOOST_TEST(modes.frequency.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
