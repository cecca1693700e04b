#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/linear/statics.h"
#include "solver/linear/validate.h"
#include "solver/manipulator/effect_estimates.h"

BOOST_AUTO_TEST_SUITE(energy_shares)

using namespace trammel::solver;
using Eigen::VectorXd;

namespace {

/// A clamped Timoshenko beam under forces at its tip, whose own rotation has an inertia.
Model cantilever(const Vector2d& force) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {0.5, 0}}};
  Member member;
  member.nodes = {0, 1};
  member.theory = BeamTheory::timoshenko;
  member.section.EA = 7e6;
  member.section.EI = 2e3;
  member.section.kappa_GA = 9e4;
  member.end_section = member.section;
  member.ends[1] = {EndFixity::hinged};
  member.ends[1].inertia = 0.3;
  model.members = {member};
  model.supports = {{"A", 0, {true, true, true}}};
  model.loads = {{1, {force.x(), force.y(), 0}}};
  return model;
}

}  // namespace

BOOST_AUTO_TEST_CASE(energies_of_a_cantilever_are_shared_as_its_compliances) {
  const Vector2d force(300, 20);
  const double stretch = force.x() * force.x() * 0.5 / 7e6;
  const double bending = force.y() * force.y() * 0.125 / (3 * 2e3);
  const double shear = force.y() * force.y() * 0.5 / 9e4;
  const System system = assemble(cantilever(force));
  const VectorXd q = solve_statics(system).q;
  const EnergyShares shares(system, q, q.dot(system.K * q));
  const double all = stretch + bending + shear;
  const auto close = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(shares.elastic(Effect::axial_flexibility) == stretch / all, close);
  BOOST_TEST(shares.elastic(Effect::shear) == shear / all, close);
  BOOST_TEST(shares.elastic(Effect::joint_compliance) == 0);
}

BOOST_AUTO_TEST_CASE(a_spring_of_the_model_is_no_joint_and_a_sprung_end_is) {
  Model model = cantilever({0, 20});
  model.members[0].ends[0] = {EndFixity::sprung, 1e4, 0};
  model.springs = {{"s", {1, -1}, {0, 3e4, 0}}};
  const System system = assemble(model);
  const VectorXd q = solve_statics(system).q;
  const EnergyShares shares(system, q, q.dot(system.K * q));
  const double spring = 3e4 * std::pow(solve_statics(system).displacement(1, 1), 2);
  const double moment = 0.5 * (20 - 3e4 * solve_statics(system).displacement(1, 1));
  BOOST_TEST(spring > 0);
  BOOST_TEST(
      shares.elastic(Effect::joint_compliance) == moment * moment / 1e4 / q.dot(system.K * q),
      boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(the_inertia_of_a_members_end_counts_where_it_turns_by_itself) {
  BOOST_TEST(applicable_effects(cantilever({0, 20})).has(Effect::link_mass));
  const System system = assemble(cantilever({0, 20}));
  const VectorXd q = solve_statics(system).q;
  const double turned = 20 * 0.25 / (2 * 2e3);
  BOOST_TEST(EnergyShares(system, q, 1).kinetic(false) == 0.3 * turned * turned,
             boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_three_quarters_of_its_compliance_a_spring_swings_twice_as_fast) {
  BOOST_TEST(frequency_change_without(0.75) == 1);
}

BOOST_AUTO_TEST_SUITE_END()
