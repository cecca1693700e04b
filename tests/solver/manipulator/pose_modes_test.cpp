// Tests that frequencies along a path equal those of a separate solution for each pose.
#include "solver/manipulator/pose_modes.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "solver/linear/modes.h"
#include "solver/linear/validate.h"
#include "solver/manipulator/moving_pencil.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(pose_modes)

using namespace trammel::solver;

namespace {

std::vector<Pose> circle(Index points, double radius, double phi = 0) {
  std::vector<Pose> poses;
  for (Index i = 0; i < points; ++i) {
    const double t = 0.01 * static_cast<double>(i);
    poses.push_back({0.25 + radius * std::cos(t), 0.144 + radius * std::sin(t), phi});
  }
  return poses;
}

/// Returns the largest difference from `solve_modes` at all poses, relative to the round-off.
double worst_difference(const ManipulatorDesign& design, const std::vector<Pose>& poses,
                        const PoseModes& modes, Effects active = Effects::all()) {
  double worst = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Model model =
        restrict_effects(build_manipulator(restrict_effects(design, active), poses[i]), active);
    const System system = assemble(model, active);
    const Index count = modes.frequency.rows();
    const ModalSolution alone = solve_modes(system, {.count = count});
    const auto column = static_cast<Index>(i);
    BOOST_REQUIRE(alone.outcome.solved());
    BOOST_REQUIRE(modes.outcome[i].solved());
    BOOST_REQUIRE(modes.free_coordinates == system.K.rows());
    BOOST_REQUIRE(modes.zero_energy_mode_count[i] == alone.zero_energy_mode_count);
    for (Index k = 0; k < count; ++k) {
      const double here = modes.frequency(k, column), there = alone.frequency[k];
      const double rounding = modes.roundoff(k, column) + alone.roundoff[k] + 1e-14;
      worst = nan_max(worst, std::abs(here - there) / (rounding * std::max(there, 1e-6)));
    }
  }
  return worst;
}

void check(const char* what, const ManipulatorDesign& design, const std::vector<Pose>& poses,
           Index count, Index by_itself = 0, Effects active = Effects::all()) {
  const PoseModes modes = solve_pose_modes(design, poses, {.count = count, .active = active});
  BOOST_TEST(modes.by_itself == by_itself, what << ": " << modes.by_itself << " by themselves");
  const double worst = worst_difference(design, poses, modes, active);
  BOOST_TEST(worst < 2, what << ": " << worst << " times the round-off");
}

}  // namespace

BOOST_AUTO_TEST_CASE(roundoff_estimate_equals_that_of_single_poses) {
  const ManipulatorDesign design = meshed_design(16);
  const std::vector<Pose> poses = circle(5, 0.01);
  const PoseModes modes = solve_pose_modes(design, poses, {.count = 3});
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const System system = assemble(build_manipulator(design, poses[i]));
    const Eigen::VectorXd alone = solve_modes(system, {.count = 3}).roundoff;
    for (Index k = 0; k < 3; ++k) {
      const double ratio = modes.roundoff(k, static_cast<Index>(i)) / alone[k];
      BOOST_TEST((ratio > 0.1 && ratio < 5), ratio << " times that alone, " << alone[k]);
    }
  }
}

BOOST_AUTO_TEST_CASE(poses_of_a_circle_have_their_frequencies) {
  for (const Index elements : {1, 2, 4})
    check("rigid", meshed_design(elements), circle(70, 0.01), 3);
  check("sixteen elements", meshed_design(16), circle(5, 0.01), 8);
  check("triangles", meshed_design(4, PlatformKind::triangles), circle(20, 0.03, 0.2), 6);
}

BOOST_AUTO_TEST_CASE(joints_masses_and_theories_are_condensed_exactly) {
  const std::vector<Pose> poses = circle(6, 0.02, 0.1);
  ManipulatorDesign design = meshed_design(3);
  design.elbow.fill({ElbowKind::sprung, 40});
  design.active.fill({ActiveKind::sprung, 60});
  design.platform_joint.fill({PlatformJointKind::sprung, 5});
  check("sprung", design, poses, 6);
  design.platform_joint.fill({PlatformJointKind::welded});
  for (LinkDesign& link : design.proximal) {
    link.theory = BeamTheory::timoshenko;
    link.thickness = 0.02;
  }
  for (LinkDesign& link : design.distal) {
    link.mass_matrix = MassMatrix::lumped;
    link.mass = 0.2;
    link.inertia = 1e-3;
  }
  check("Timoshenko and lumped", design, poses, 6);
  design.platform_joint.fill({PlatformJointKind::eq25_mean});
  check("Eq. 25", design, poses, 4);
}

BOOST_AUTO_TEST_CASE(pose_modes_respect_inactive_effects) {
  const ManipulatorDesign design = meshed_design(4);
  const Effects all = Effects::all();
  check("inextensible", design, circle(6, 0.02), 3, 0, all.without(Effect::axial_flexibility));
  check("massless links", design, circle(3, 0.02), 3, 3, all.without(Effect::link_mass));
}

BOOST_AUTO_TEST_CASE(repeated_frequencies_keep_their_multiplicity) {
  // At the center, the manipulator has a threefold symmetry with pairs of equal frequencies.
  const std::vector<Pose> poses(3, centered_pose());
  const ManipulatorDesign design = meshed_design(4);
  for (const Index count : {1, 2, 3, 4, 5, 6}) check("repeated", design, poses, count);
  const PoseModes modes = solve_pose_modes(design, poses, {.count = 6});
  Index pairs = 0;
  for (Index k = 1; k < 6; ++k)
    pairs += modes.frequency(k, 2) - modes.frequency(k - 1, 2) < 1e-10 * modes.frequency(k, 2);
  BOOST_TEST(pairs >= 2);
}

BOOST_AUTO_TEST_CASE(distant_and_near_singular_poses_are_certified) {
  ManipulatorDesign design = meshed_design(2);
  design.geometry = uneven_geometry();
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> x(0.2, 0.4), phi(-1.2, 1.2);
  std::vector<Pose> poses;
  while (poses.size() < 60) {
    const Pose pose{x(engine), x(engine) - 0.1, phi(engine)};
    if (inverse_kinematics(design.geometry, pose).outcome.solved()) poses.push_back(pose);
  }
  const PoseModes modes = solve_pose_modes(design, poses, {.count = 4});
  BOOST_TEST(worst_difference(design, poses, modes) < 2);
  BOOST_TEST(modes.by_itself < 10);
  // Hinged elbows allow a parallel singularity, where the stiffness of a mode vanishes.
  ManipulatorDesign hinged = meshed_design(1);
  hinged.elbow.fill({ElbowKind::hinged});
  hinged.geometry.base = equilateral_base(0.5);
  const std::vector<Pose> near = {{0.25, 0.144, 0.3}, {0.25, 0.144, 1e-9}, {0.25, 0.144, 0.3}};
  BOOST_TEST(worst_difference(hinged, near, solve_pose_modes(hinged, near, {.count = 4})) < 2);
}

BOOST_AUTO_TEST_CASE(mode_orthogonal_to_the_previous_pose_is_found) {
  // Arm 3 fixes the platform, so that arms 1 and 2 vibrate independently. At first, arm 1 has the
  // six lowest modes. When arm 2 is stretched, its heavy distal link has a lower frequency.
  ManipulatorDesign design = meshed_design(4);
  for (const std::size_t arm : {0, 1}) design.elbow[arm] = {ElbowKind::hinged};
  design.platform_joint[2] = {PlatformJointKind::welded};
  for (auto* links : {&design.proximal, &design.distal}) (*links)[2].material.E *= 1e16;
  design.proximal[1].material.E *= 480;
  design.distal[1].material.E *= 48000;
  design.distal[1].material.rho *= 100;
  // Returns a pose at which arm 2 has the length `reach` from its base to its platform joint.
  const auto with_reach = [](double reach) {
    const double c = std::numbers::sqrt2 / 2;
    return Pose{0.4 - c * reach, c * reach + 0.1 / std::numbers::sqrt3, 0};
  };
  // The first pose is repeated until no iteration vector has a component in arm 2.
  std::vector<Pose> poses(63, with_reach(0.37));
  poses.push_back(with_reach(0.4 - 5e-7));
  check("one arm alone", design, poses, 1);
}

BOOST_AUTO_TEST_CASE(poses_with_free_actuators_are_solved_one_by_one) {
  ManipulatorDesign design = meshed_design(2);
  design.active.fill({ActiveKind::free});
  check("free", design, circle(3, 0.01), 5, 3);
}

BOOST_AUTO_TEST_CASE(pose_out_of_reach_stops_no_other_pose) {
  const std::vector<Pose> poses = {{0.25, 0.144, 0}, {5, 5, 0}, {0.26, 0.144, 0}};
  const PoseModes modes = solve_pose_modes(meshed_design(1), poses, {.count = 2});
  BOOST_TEST(modes.outcome[0].solved());
  BOOST_TEST((modes.outcome[1].status == Status::singular));
  BOOST_TEST(std::isnan(modes.frequency(0, 1)));
  BOOST_TEST(modes.outcome[2].solved());
  const PoseModes none = solve_pose_modes(meshed_design(1), {{5, 5, 0}}, {.count = 2});
  BOOST_TEST(!none.outcome[0].solved());
}

BOOST_AUTO_TEST_CASE(results_are_bit_identical_for_any_thread_count) {
  const std::vector<Pose> poses = circle(300, 0.01);
  const ManipulatorDesign design = meshed_design(2);
  const PoseModes one = solve_pose_modes(design, poses, {.count = 3, .threads = 1});
  const PoseModes four = solve_pose_modes(design, poses, {.count = 3, .threads = 4});
  BOOST_TEST((one.frequency.array() == four.frequency.array()).all());
  BOOST_TEST((one.roundoff.array() == four.roundoff.array()).all());
  BOOST_TEST(one.counters.solves == four.counters.solves);
}

BOOST_AUTO_TEST_CASE(mode_count_below_a_shift_is_that_of_the_full_model) {
  const Pose at{0.27, 0.13, 0.1};
  for (const Index elements : {1, 3, 8}) {
    const ManipulatorDesign design = meshed_design(elements);
    const Model model = build_manipulator(design, at);
    const Pose elsewhere = centered_pose();
    MovingPencil here(build_manipulator(design, elsewhere), design.geometry, elsewhere);
    BOOST_REQUIRE(here.move_to(inverse_kinematics(design.geometry, at), at).solved());
    const System system = assemble(model);
    for (double f = 5; f < 2e5; f *= 1.31) {
      const std::optional<Index> whole = sturm_count(system, f);
      BOOST_REQUIRE(whole.has_value());
      BOOST_TEST(here.eigenvalues_below(std::pow(2 * std::numbers::pi * f, 2)) == *whole);
    }
  }
}

BOOST_AUTO_TEST_CASE(number_of_solves_stays_small) {  // counts are reproducible, unlike times
  const PoseModes modes = solve_pose_modes(meshed_design(4), circle(640, 0.01), {.count = 3});
  BOOST_TEST(modes.by_itself == 0);
  BOOST_TEST(modes.counters.solves < 640 * 6 * 6);  // six vectors, six inverse iterations per pose
  BOOST_TEST(modes.coupling < 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
