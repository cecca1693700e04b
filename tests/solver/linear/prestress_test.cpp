#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/elements/block_mesh.h"
#include "solver/linear/buckling.h"
#include "solver/linear/geometric_stiffness.h"
#include "solver/linear/modes.h"
#include "solver/linear/statics.h"
#include "tests/support/solver/frames.h"
#include "tests/support/solver/side_loads.h"

BOOST_AUTO_TEST_SUITE(prestress)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

constexpr double kPi = std::numbers::pi;

/// Unit column from the origin along an angle, compressed by 1 N at its top.
Model column(Index elements, double angle, bool foot_clamped, bool top_guided_along = false) {
  Model model = beam(unit_section(1e6), 1, elements, angle);
  model.supports = {foot_clamped ? clamp(0) : pin(0)};
  model.loads = {{1, {-std::cos(angle), -std::sin(angle), 0}}};
  if (top_guided_along) {
    LinearConstraint guide{"guide", {}};
    guide.terms = {{{Coordinate::Kind::x, 1, -1, 0}, -std::sin(angle)},
                   {{Coordinate::Kind::y, 1, -1, 0}, std::cos(angle)}};
    model.constraints = {guide};
  }
  return model;
}

double first_factor(const Model& model, EigenMethod path = EigenMethod::automatic) {
  const BucklingSolution b = solve_buckling(assemble(model), {1, path});
  BOOST_REQUIRE(b.outcome.solved());
  BOOST_REQUIRE(b.load_factor.size() == 1);
  return b.load_factor[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(eulers_four_columns_buckle_at_their_loads_but_for_the_fourth_power_over_720) {
  const auto check = [](const Model& model, double k) {
    BOOST_TEST(first_factor(model) / (k * k) - 1 == std::pow(k / 16, 4) / 720, tolerance(0.03));
  };
  for (const double angle : {0.0, 0.8, kPi / 2}) {
    check(column(16, angle, true), kPi / 2);
    check(column(16, angle, false, true), kPi);
    check(column(16, angle, true, true), 4.49340945790906418);
    Model clamped = column(16, angle, true, true);
    clamped.constraints.push_back({"no turning", {{{Coordinate::Kind::rotation, 1, -1, 0}, 1}}});
    check(clamped, 2 * kPi);
  }
}

BOOST_AUTO_TEST_CASE(buckling_loads_converge_with_the_fourth_power) {
  const auto error = [](Index n) {
    return first_factor(column(n, 0.3, true)) / (kPi * kPi / 4) - 1;
  };
  BOOST_TEST(std::log2(error(4) / error(8)) == 4, tolerance(0.02));
  BOOST_TEST(error(8) > 0);
}

BOOST_AUTO_TEST_CASE(both_paths_give_the_same_factors) {
  const System system = assemble(column(40, 0.3, true));
  const BucklingSolution dense = solve_buckling(system, {4, EigenMethod::dense});
  const BucklingSolution sparse = solve_buckling(system, {4, EigenMethod::sparse});
  BOOST_REQUIRE(dense.load_factor.size() == 4);
  BOOST_REQUIRE(sparse.load_factor.size() == 4);
  for (Index i = 0; i < 4; ++i) {
    BOOST_TEST(sparse.load_factor[i] == dense.load_factor[i], tolerance(1e-10));
  }
}

BOOST_AUTO_TEST_CASE(a_column_under_its_own_weight_buckles_as_greenhill_says) {
  Model model = beam(unit_section(1e6), 1, 16, kPi / 2);
  model.supports = {clamp(0)};
  model.gravity = {0, -1};
  BOOST_TEST(first_factor(model) == 7.83734743, tolerance(2e-6));
}

BOOST_AUTO_TEST_CASE(tension_does_not_buckle) {
  Model model = column(8, 0.3, true);
  model.loads[0].force *= -1;
  const BucklingSolution b = solve_buckling(assemble(model), {3, EigenMethod::automatic});
  BOOST_TEST(b.outcome.solved());
  BOOST_TEST(b.load_factor.size() == 0);
}

BOOST_AUTO_TEST_CASE(an_inextensible_column_buckles_as_a_stiff_one) {
  Model model = column(8, 0.3, true);
  const double stiff = first_factor(model);
  model.members[0].axially_flexible = false;
  BOOST_TEST(first_factor(model) == stiff, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(a_timoshenko_column_buckles_earlier_by_its_shear) {
  Section section = unit_section(1e6);
  section.kappa_GA = 50;
  Model model = column(32, 0.3, true);
  model.members[0].section = model.members[0].end_section = section;
  model.members[0].theory = BeamTheory::timoshenko;
  const double euler = kPi * kPi / 4;
  BOOST_TEST(first_factor(model) == euler / (1 + euler / 50), tolerance(2e-3));
}

BOOST_AUTO_TEST_CASE(a_rigid_inverted_pendulum_on_a_spring_falls_at_k_over_l) {
  // A rigid arm of 2 m on a rotational spring of 10 N m, pressed down by 1 N.
  Model model;
  model.nodes = {{"foot", {0, 0}}, {"head", {0, 2}}};
  model.rigid_bodies = {{"arm", 0, {1}}};
  model.supports = {pin(0)};
  model.springs = {{"k", {0, -1}, {0, 0, 10}}};
  model.loads = {{1, {0, -1, 0}}};
  BOOST_TEST(first_factor(model) == 5, tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(a_hanging_offset_mass_swings_as_a_pendulum_with_its_spring) {
  Model model;
  model.nodes = {{"pivot", {0, 0}}};
  model.masses = {{0, 2, 0, {0, -3}}};
  model.supports = {pin(0)};
  model.springs = {{"k", {0, -1}, {0, 0, 10}}};
  model.gravity = {0, -9.81};
  const ModalSolution r = solve_prestressed_modes(assemble(model), {1, EigenMethod::dense});
  BOOST_REQUIRE_MESSAGE(r.outcome.solved(), r.outcome.reason);
  BOOST_TEST(r.frequency[0] == std::sqrt((10 + 2 * 9.81 * 3) / (2 * 9)) / (2 * kPi),
             tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(the_tie_rod_vm21_is_stiffened_by_its_tension) {
  const double E = 30e6;
  const double I = 2.5 * 2.5 * 2.5 * 2.5 / 12;
  Model model;
  model.nodes = {{"A", {0, 0}}, {"C", {100, 0}}, {"B", {200, 0}}};
  const Section section = {E * 6.25, E * I, 0, 0, 0, 6.25, I / 1.25};
  model.members = {member("AC", 0, 1, section, 8), member("CB", 1, 2, section, 8)};
  for (Member& m : model.members) m.load = {0, -1.79253};
  model.supports = {pin(0), roller(2)};
  const StaticSolution without = solve_statics(assemble(model), {.second_order = true});
  BOOST_TEST(without.displacement(1, 1) == -0.382411, tolerance(2e-5));
  model.loads = {{2, {21972.6, 0, 0}}};
  const StaticSolution with = solve_statics(assemble(model), {.second_order = true});
  BOOST_TEST(with.displacement(1, 1) == -0.199452, tolerance(1e-5));
  BOOST_TEST(std::abs(with.displacement(0, 2)) == 0.0032352, tolerance(1e-4));
  BOOST_TEST(with.resultant_end(0, 2) == 4580.1, tolerance(1e-4));
  BOOST_TEST(with.equilibrium_residual < 1e-6);
  const StaticSolution first_order = solve_statics(assemble(model));
  BOOST_TEST(first_order.displacement(1, 1) == without.displacement(1, 1), tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(tension_raises_the_frequencies_of_a_beam_as_sdll101_says) {
  const double E = 2e11;
  const double A = kPi * 25e-6;
  const double I = kPi * std::pow(0.005, 4) / 4;
  for (const double N : {0.0, 100.0, 1000.0}) {
    Model model = beam({E * A, E * I, 0, 7800 * A, 0, A, I / 0.005}, 2, 24, 0.5);
    model.supports = {pin(0)};
    const double c = std::cos(0.5);
    const double s = std::sin(0.5);
    model.constraints = {
        {"guide", {{{Coordinate::Kind::x, 1, -1, 0}, -s}, {{Coordinate::Kind::y, 1, -1, 0}, c}}}};
    model.loads = {{1, {N * c, N * s, 0}}};
    const ModalSolution r = solve_prestressed_modes(assemble(model), {5, EigenMethod::dense});
    BOOST_REQUIRE_MESSAGE(r.outcome.solved(), r.outcome.reason);
    for (int n = 1; n <= 5; ++n) {
      const double k2 = n * n * kPi * kPi / 4;
      const double exact = n / 4.0 * std::sqrt((N + E * I * k2) / (7800 * A));
      BOOST_TEST(r.frequency[n - 1] == exact, tolerance(2e-4));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_load_past_buckling_has_no_stable_state) {
  Model model = column(8, 0.3, true);
  model.loads[0].force *= 3;  // pi^2 / 4 = 2.47
  const ModalSolution r = solve_prestressed_modes(assemble(model), {3, EigenMethod::dense});
  BOOST_TEST((r.outcome.status == Status::singular));
  BOOST_TEST(r.outcome.reason.starts_with("the loads reach or exceed the buckling load"));
  BOOST_TEST(r.frequency.size() == 0);
}

BOOST_AUTO_TEST_CASE(a_plate_strip_buckles_as_the_column_it_is) {
  Block block;
  block.corners = {Vector2d(0, 0), Vector2d(1, 0), Vector2d(1, 0.02), Vector2d(0, 0.02)};
  block.cells = {24, 1};
  const BlockMesh mesh = mesh_blocks({block}, true);
  Model model;
  model.plates = {{"strip", {12 / 8e-6, 0, 0}, 1}};  // E I = 1
  const std::vector<Index> nodes = append(model, 0, mesh);
  for (const Index node : mesh.sides[0][3]) {
    model.supports.push_back({"", nodes[static_cast<std::size_t>(node)], {true, true, false}});
  }
  model.edge_loads = side_loads(mesh, nodes, 0, 0, 1, {-50, 0}, 0);  // 1 N in all
  BOOST_TEST(first_factor(model) == kPi * kPi / 4, tolerance(2e-3));
}

BOOST_AUTO_TEST_SUITE_END()
