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

/// Returns a unit cantilever (E I = 1, 1 kg/m, 1 m) that points outward from a hub of radius r.
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

BOOST_AUTO_TEST_CASE(modes_at_rest_are_the_ordinary_modes) {
  const Model model = pinned_double_cross(4);
  const ModalSolution ordinary = solve_modes(assemble(model), {16, EigenMethod::dense});
  for (const EigenMethod path : {EigenMethod::dense, EigenMethod::sparse}) {
    const RotatingModes r = rotate(model, 0, 16, path);
    BOOST_REQUIRE_MESSAGE(r.outcome.solved(), r.outcome.reason);
    for (Index i = 0; i < 16; ++i)
      BOOST_TEST(r.frequency[i] == ordinary.frequency[i], tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(squared_lag_frequency_falls_by_the_squared_speed) {
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

BOOST_AUTO_TEST_CASE(both_eigenvalue_methods_agree_in_a_rotating_frame) {
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
    for (Index i = 0; i < 6; ++i)
      BOOST_TEST(dense.frequency[i] == sparse.frequency[i], tolerance(1e-9));
  }
}

BOOST_AUTO_TEST_CASE(huge_coordinates_do_not_crash) {
  Model model = blade(0, 4);
  for (const double size : {1e100, 1e155, 1e300}) {
    Model far = model;
    for (Node& node : far.nodes) node.position *= size;
    for (const EigenMethod path : {EigenMethod::automatic, EigenMethod::sparse}) {
      try {
        const RotatingModes r = rotate(far, 10, 2, path);
        BOOST_TEST((!r.outcome.solved() || r.frequency.size() == 2), size);
      } catch (const ModelError& error) {  // overflow of lengths
        BOOST_TEST(size >= 1e155, error.what());
      }
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
