#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/modes.h"
#include "solver/linear/rotating_frame.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(rotating_modes)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

constexpr double kPi = std::numbers::pi;

/// ANSYS VM197: a mass on two springs in a frame rotating about the origin, at radius 0.2 m along
/// y.
Model friswell() {
  Model model;
  model.nodes = {{"mass", {0, 0.2}}};
  model.masses = {{0, 0.2, 0, {0, 0}}};
  model.springs = {{"k", {0, -1}, {4e4, 2e5, 0}}};
  return model;
}

/// Unit cantilever (E I = 1, 1 kg/m, 1 m) that points outward from a hub of radius r.
Model blade(double hub, Index elements, double angle = 0.4) {
  Model model = beam(unit_section(1e7), 1, elements, angle);
  const Vector2d direction(std::cos(angle), std::sin(angle));
  for (Node& node : model.nodes) node.position += hub * direction;
  model.supports = {clamp(0)};
  return model;
}

RotatingModes rotate(const Model& model, double speed, Index count,
                     EigenMethod path = EigenMethod::automatic) {
  return solve_rotating_modes(assemble(model), {{speed, {0, 0}}, count, path});
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_mass_on_springs_in_a_rotating_frame_is_that_of_friswell) {
  const double rpm = kPi / 30;
  const double printed[][4] = {
      {0, 71.18, 159.15, 0}, {500, 70.21, 160.02, 0.5498e-3}, {1000, 67.40, 162.51, 2.218e-3}};
  for (const auto& row : printed) {
    const RotatingModes r = rotate(friswell(), row[0] * rpm, 2);
    BOOST_REQUIRE_MESSAGE(r.outcome.solved(), r.outcome.reason);
    BOOST_TEST(r.stable);
    BOOST_TEST(r.frequency[0] == row[1], tolerance(1e-4));
    BOOST_TEST(r.frequency[1] == row[2], tolerance(1e-4));
    BOOST_TEST(r.q[1] == row[3], tolerance(4e-4));
  }
}

BOOST_AUTO_TEST_CASE(beyond_the_softer_natural_frequency_the_mass_flies_off) {
  const RotatingModes r = rotate(friswell(), 8000 * kPi / 30, 2);
  BOOST_REQUIRE(r.outcome.solved());
  BOOST_TEST(!r.stable);
  BOOST_TEST(r.frequency[0] == 0);
  BOOST_TEST(r.growth_rate[0] > 0);
  BOOST_TEST(r.frequency[1] == 259.57, tolerance(1e-4));
  BOOST_TEST(r.q[1] == 470.8e-3, tolerance(2e-4));
  BOOST_TEST(rotate(friswell(), 4270 * kPi / 30, 2).stable);
  BOOST_TEST(!rotate(friswell(), 4272 * kPi / 30, 2).stable);
}

BOOST_AUTO_TEST_CASE(at_rest_the_modes_are_the_ordinary_ones) {
  const Model model = pinned_double_cross(4);
  const ModalSolution ordinary = solve_modes(assemble(model), {16, EigenMethod::dense});
  for (const EigenMethod path : {EigenMethod::dense, EigenMethod::sparse}) {
    const RotatingModes r = rotate(model, 0, 16, path);
    BOOST_REQUIRE_MESSAGE(r.outcome.solved(), r.outcome.reason);
    for (Index i = 0; i < 16; ++i) {
      BOOST_TEST(r.frequency[i] == ordinary.frequency[i], tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_rotating_blade_vibrates_in_its_plane_as_wright_says) {
  // Without extension there is no Coriolis coupling: E A = 1e7 leaves 1e-5.
  struct Row {
    double hub, eta, lag;
  };
  for (const Row& row :
       {Row{0, 2, 3.62179696412}, Row{0, 10, 5.04897487538}, Row{1, 2, 4.40051679996},
        Row{1, 10, 13.2578764078}, Row{5, 10, 27.7262204568}}) {
    const RotatingModes r = rotate(blade(row.hub, 24), row.eta, 1);
    BOOST_REQUIRE(r.outcome.solved());
    BOOST_TEST(2 * kPi * r.frequency[0] == row.lag, tolerance(2e-4));
  }
}

BOOST_AUTO_TEST_CASE(the_blade_of_vm54_is_that_of_beam_theory) {
  const Section section = rectangle({217e9, 7850, 0.3}, 0.003, 0.028);
  Model model = beam(section, 0.328, 24);
  for (Node& node : model.nodes) node.position.x() += 0.15;
  model.supports = {clamp(0)};
  BOOST_TEST(rotate(model, 0, 1).frequency[0] == 23.6837, tolerance(1e-5));
  const double flexible = rotate(model, 314.159, 1).frequency[0];
  model.members[0].section.EA *= 1e4;
  model.members[0].end_section = model.members[0].section;
  BOOST_TEST(rotate(model, 314.159, 1).frequency[0] == 51.7079, tolerance(5e-6));
  // The stretching blade is a little slower by the Coriolis coupling, which beam theory leaves out.
  BOOST_TEST(flexible / 51.7079 - 1 < -1e-4);
  BOOST_TEST(flexible / 51.7079 - 1 > -3e-4);
}

BOOST_AUTO_TEST_CASE(a_rotating_blade_flaps_as_wright_says) {
  // About an axis in the plane and across the blade, which flaps along that axis.
  struct Row {
    double hub, eta, flap;
  };
  for (const Row& row : {Row{0, 2, 4.13731957303}, Row{0, 10, 11.2023277622},
                         Row{1, 2, 4.83368887153}, Row{1, 10, 16.6063628422}}) {
    for (const RotationAxis axis : {RotationAxis::x, RotationAxis::y}) {
      for (const bool rigid : {true, false}) {
        Model model = blade(row.hub, 24, axis == RotationAxis::y ? 0 : kPi / 2);
        model.members[0].axially_flexible = !rigid;
        const RotatingModes r = solve_rotating_modes(assemble(model), {{row.eta, {0, 0}, axis}, 1});
        BOOST_REQUIRE(r.outcome.solved());
        BOOST_TEST(2 * kPi * r.frequency[0] == row.flap, tolerance(rigid ? 3e-6 : 2e-5));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(what_flaps_is_not_softened_and_what_lags_is_by_the_square_of_the_speed) {
  for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
    Model model = blade(0.5, 12, 0);
    model.members[0].axially_flexible = false;
    model.members[0].mass = mass;
    const System system = assemble(model);
    const double W = 3;
    const RotatingModes lag = solve_rotating_modes(system, {{W, {0, 0}}, 3});
    const RotatingModes flap = solve_rotating_modes(system, {{W, {0, 0}, RotationAxis::y}, 3});
    for (Index i = 0; i < 3; ++i) {
      const double square = std::pow(2 * kPi * flap.frequency[i], 2);
      BOOST_TEST(std::pow(2 * kPi * lag.frequency[i], 2) == square - W * W, tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(without_the_coriolis_coupling_the_blade_is_faster) {
  const System system = assemble(blade(1, 24));
  RotatingOptions options{{10, {0, 0}}, 1};
  const double coupled = solve_rotating_modes(system, options).frequency[0];
  options.gyroscopic = false;
  BOOST_TEST(solve_rotating_modes(system, options).frequency[0] > coupled);
}

BOOST_AUTO_TEST_CASE(the_rotating_bar_stretches_by_the_tangent) {
  // u(L) = tan(k L) / k - L with k = W sqrt(rho A / E A).
  const double k = 6 * std::sqrt(1.2 / 2.8e7);
  Model model = beam({2.8e7, 1.4e4, 0, 1.2, 0, 1, 1}, 10, 16, 0.3);
  model.supports = {clamp(0)};
  const RotatingModes r = rotate(model, 6, 1);
  const Eigen::MatrixX3d motion = node_motion(assemble(model), r.q);
  const double u = motion.row(1).head<2>().norm();
  BOOST_TEST(u == std::tan(10 * k) / k - 10, tolerance(1e-6));
  BOOST_TEST(u == 5.143175e-4, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(both_paths_and_mass_matrices_agree_in_a_rotating_frame) {
  Model model = blade(0.5, 16);
  model.nodes.push_back({"C", model.nodes[1].position + Vector2d(0.2, -0.4)});
  model.members.push_back(member("BC", 1, 2, unit_section(1e4), 8));
  model.masses = {{2, 0.3, 0.01, {0.05, 0.02}}};
  for (const MassMatrix mass : {MassMatrix::consistent, MassMatrix::lumped}) {
    for (Member& m : model.members) m.mass = mass;
    const RotatingModes dense = rotate(model, 1.5, 6, EigenMethod::dense);
    const RotatingModes sparse = rotate(model, 1.5, 6, EigenMethod::sparse);
    BOOST_REQUIRE_MESSAGE(dense.outcome.solved(), dense.outcome.reason);
    BOOST_REQUIRE_MESSAGE(sparse.outcome.solved(), sparse.outcome.reason);
    for (Index i = 0; i < 6; ++i) {
      BOOST_TEST(dense.frequency[i] == sparse.frequency[i], tolerance(1e-9));
    }
  }
}

BOOST_AUTO_TEST_CASE(the_sense_of_rotation_does_not_matter_and_the_angle_neither) {
  const RotatingModes one = rotate(blade(0.5, 8, 0.0), 3, 4);
  const RotatingModes back = rotate(blade(0.5, 8, 0.0), -3, 4);
  const RotatingModes turned = rotate(blade(0.5, 8, 2.2), 3, 4);
  for (Index i = 0; i < 4; ++i) {
    BOOST_TEST(back.frequency[i] == one.frequency[i], tolerance(1e-9));
    BOOST_TEST(turned.frequency[i] == one.frequency[i], tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(every_shape_satisfies_the_equation_of_the_rotating_frame) {
  const System system = assemble(blade(0.5, 8));
  const double W = 3;
  const RotatingModes r = solve_rotating_modes(system, {{W, {0, 0}}, 4, EigenMethod::dense});
  const SparseMatrix G = gyroscopic_matrix(system);
  const Eigen::MatrixXd sum = Eigen::MatrixXd(G) + Eigen::MatrixXd(G).transpose();
  BOOST_TEST(sum.isZero(0));
  for (Index i = 0; i < 4; ++i) {
    // The Coriolis term does no work, so x^H (K + K_G - W^2 S) x + c w = w^2 m with real c.
    const std::complex<double> c =
        std::complex<double>(0, 2 * W) * r.shape.col(i).dot(G * r.shape.col(i));
    BOOST_TEST(std::abs(c.imag()) < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(a_rigid_arm_and_an_offset_mass_feel_the_same_centrifugal_stiffness) {
  // A mass 0.5 m off its node by an offset, or at the end of a rigid arm: the same pendulum.
  Model offset;
  offset.nodes = {{"pivot", {0.3, 0}}};
  offset.masses = {{0, 2, 0, {0.5, 0}}};
  offset.supports = {pin(0)};
  offset.springs = {{"k", {0, -1}, {0, 0, 10}}};
  Model arm;
  arm.nodes = {{"pivot", {0.3, 0}}, {"end", {0.8, 0}}};
  arm.rigid_bodies = {{"arm", 0, {1}}};
  arm.masses = {{1, 2, 0, {0, 0}}};
  arm.supports = {pin(0)};
  arm.springs = offset.springs;
  const double W = 4;
  // I θ.. + (k + m W^2 r l) θ = 0, r the pivot's radius, l the arm's length.
  const double exact = std::sqrt((10 + 2 * W * W * 0.3 * 0.5) / (2 * 0.25)) / (2 * kPi);
  BOOST_TEST(rotate(offset, W, 1).frequency[0] == exact, tolerance(1e-10));
  BOOST_TEST(rotate(arm, W, 1).frequency[0] == exact, tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(coordinates_without_bounds_give_no_modes_and_no_crash) {
  Model model = blade(0, 4);
  for (const double size : {1e100, 1e155, 1e300}) {
    Model far = model;
    for (Node& node : far.nodes) node.position *= size;
    for (const EigenMethod path : {EigenMethod::automatic, EigenMethod::sparse}) {
      try {
        const RotatingModes r = rotate(far, 10, 2, path);
        BOOST_TEST((!r.outcome.solved() || r.frequency.size() == 2), size);
      } catch (const ModelError& error) {  // a length beyond the range of numbers
        BOOST_TEST(size >= 1e155, error.what());
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
