#include <boost/test/unit_test.hpp>

#include "solver/elements/block_mesh.h"
#include "solver/linear/fields.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(consistent_load)

namespace t = trammel::solver;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

constexpr double kThickness = 0.02;

t::System membrane(double distortion) {
  return t::assemble(
      t::mesh_rectangle({0.8, 0.5, 3, false, distortion}, {"p", {7e10, 2700, 0.3}, kThickness}));
}

/// Force and moment about the origin of all nodal forces.
Vector3d resultant(const t::System& system) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    const Vector2d& p = system.model.nodes[i].position;
    const auto& c = system.coordinates.node[i];
    const Vector2d f(system.load[c[0]], system.load[c[1]]);
    sum += Vector3d(f.x(), f.y(), p.x() * f.y() - p.y() * f.x());
    if (c[2] >= 0) sum[2] += system.load[c[2]];
  }
  return sum;
}

t::System inclined_beam(t::BeamTheory theory) {
  t::Model model = trammel::testing::inclined_line(theory);
  model.supports.push_back({"start", 0, {true, true, true}});
  return t::assemble(model);
}

}  // namespace

BOOST_AUTO_TEST_CASE(body_force_has_the_resultant_of_its_integral) {
  t::System system = membrane(0.25);
  t::add_body_force(system, [](const Vector2d& p) { return Vector2d(6 * p.x(), 2 + p.y()); });
  // Over [0, 0.8] x [0, 0.5] times the thickness: integrals of 6x, 2 + y and x (2 + y) - y 6x.
  const Vector3d sum = resultant(system) / kThickness;
  BOOST_TEST(sum[0] == 3 * 0.64 * 0.5, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(sum[1] == 0.8 * (1.0 + 0.125), boost::test_tools::tolerance(1e-13));
  BOOST_TEST(sum[2] == 0.32 * 1.125 - 6 * 0.32 * 0.125, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(uniform_body_force_is_shared_in_thirds_like_a_weight) {
  t::Model model = membrane(0.25).model;
  t::System by_field = t::assemble(model);
  t::add_body_force(by_field, [](const Vector2d&) { return Vector2d(0, -9.81 * 2700); });
  model.gravity = Vector2d(0, -9.81);
  const t::System by_gravity = t::assemble(model);
  BOOST_TEST((by_field.f - by_gravity.f).norm() < 1e-13 * by_gravity.f.norm());
  BOOST_TEST(by_gravity.f.norm() > 0);
}

BOOST_AUTO_TEST_CASE(pressure_all_around_has_no_resultant_and_pushes_inwards) {
  t::System system = membrane(0.25);
  t::add_edge_traction(system, [](const Vector2d&, const Vector2d& n) { return Vector2d(-n); });
  BOOST_TEST(resultant(system).norm() < 1e-15);
  const auto corner = system.coordinates.node[0];  // at the origin
  BOOST_TEST(system.load[corner[0]] == kThickness * 0.5 / 6, boost::test_tools::tolerance(1e-13));
  BOOST_TEST(system.load[corner[1]] == kThickness * 0.8 / 6, boost::test_tools::tolerance(1e-13));
}

BOOST_AUTO_TEST_CASE(inner_sides_carry_no_traction) {
  t::System system = membrane(0.25);
  t::add_edge_traction(system, [](const Vector2d&, const Vector2d& n) { return n; });
  for (std::size_t i = 0; i < system.model.nodes.size(); ++i) {
    const Vector2d& p = system.model.nodes[i].position;
    const bool inside = p.x() > 1e-9 && p.y() > 1e-9 && p.x() < 0.8 - 1e-9 && p.y() < 0.5 - 1e-9;
    const auto& c = system.coordinates.node[i];
    BOOST_TEST((system.load[c[0]] == 0 && system.load[c[1]] == 0) == inside);
  }
}

BOOST_AUTO_TEST_CASE(uniform_line_load_is_that_of_the_member) {
  for (const auto theory : {t::BeamTheory::euler_bernoulli, t::BeamTheory::timoshenko}) {
    t::System by_field = inclined_beam(theory);
    t::Model model = by_field.model;
    for (t::Member& member : model.members) member.load = Vector2d(30, -200);
    const t::System by_member = t::assemble(model);
    t::add_line_load(by_field, [](const Vector2d&) { return Vector3d(30, -200, 0); });
    BOOST_TEST((by_field.f - by_member.f).norm() < 1e-13 * by_member.f.norm());
  }
}

BOOST_AUTO_TEST_CASE(a_distributed_moment_does_the_work_of_its_integral_in_a_rotation) {
  for (const auto theory : {t::BeamTheory::euler_bernoulli, t::BeamTheory::timoshenko}) {
    t::System system = inclined_beam(theory);
    t::add_line_load(system, [](const Vector2d&) { return Vector3d(0, 0, 5); });
    BOOST_TEST(resultant(system)[2] == 5 * 2.0, boost::test_tools::tolerance(1e-13));
    BOOST_TEST(resultant(system).head<2>().norm() < 1e-14);
  }
}

BOOST_AUTO_TEST_SUITE_END()
