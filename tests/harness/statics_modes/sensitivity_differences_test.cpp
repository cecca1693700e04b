// ctest: timeout=300
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/statics_modes/frequency_differences.h"
#include "tests/support/harness/sensitivity_comparison.h"

BOOST_AUTO_TEST_SUITE(sensitivity_differences)

using namespace trammel::solver;
using namespace trammel::harness;

BOOST_AUTO_TEST_CASE(every_variant_of_the_model_agrees_with_differences) {
  std::vector<ManipulatorDesign> designs;
  designs.push_back(coarse_design());
  designs.push_back(coarse_design());
  designs.back().platform.kind = PlatformKind::rigid;
  designs.back().platform_joint.fill({PlatformJointKind::welded});
  designs.push_back(coarse_design());
  designs.back().platform.kind = PlatformKind::rigid;
  designs.back().platform_joint.fill({PlatformJointKind::eq25_mean});
  designs.push_back(coarse_design());
  designs.back().active.fill({ActiveKind::sprung, 5});
  designs.back().elbow.fill({ElbowKind::sprung, 2});
  designs.push_back(coarse_design());
  for (std::size_t i = 0; i < 3; ++i) {
    for (LinkDesign* link : {&designs.back().proximal[i], &designs.back().distal[i]}) {
      link->mass = 0.0234;
      link->inertia = 0.00078;
      link->theory = BeamTheory::timoshenko;
    }
  }
  designs.push_back(coarse_design());
  designs.back().platform.pin_radius = 0.02;
  designs.back().platform.refinements = 2;
  for (std::size_t i = 0; i < 3; ++i) {
    designs.back().proximal[i].axially_flexible = false;
    designs.back().distal[i].axially_flexible = false;
    designs.back().distal[i].mass_matrix = MassMatrix::lumped;
  }
  for (const ManipulatorDesign& design : designs) {
    const Comparison length = compare(design, all(Kind::length), 2, 5e-3, 1);
    BOOST_TEST(length.worst < 1e-8);
    const Comparison thickness = compare(design, all(Kind::thickness), 1, 2e-2, 2);
    BOOST_TEST(thickness.worst < 1e-8);
    const Comparison single = compare(design, one_length(1, false), 1, 5e-3, 3);
    BOOST_TEST(single.worst < 1e-8);
  }
}

/// A frequency goes with the root of all stiffness, and with one over the root of all inertia.
BOOST_AUTO_TEST_CASE(derivatives_with_every_parameter_add_up_as_dimensions_say) {
  ManipulatorDesign design = coarse_design();
  design.platform.kind = PlatformKind::rigid;
  design.platform.mass = 0.12;
  design.platform.inertia = 8e-4;
  design.active.fill({ActiveKind::sprung, 10});
  design.elbow.fill({ElbowKind::sprung, 5});
  design.platform_joint.fill({PlatformJointKind::sprung, 2});
  const Pose pose{0.27, 0.15, 0.1};
  const std::vector<Kind> stiff = {Kind::E, Kind::active_stiffness, Kind::elbow_stiffness,
                                   Kind::platform_joint_stiffness};
  const std::vector<Kind> inert = {Kind::density, Kind::platform_mass, Kind::platform_inertia};
  for (const auto& [kinds, degree] : {std::pair(stiff, 0.5), std::pair(inert, -0.5)}) {
    VectorXd sum = VectorXd::Zero(4), frequency;
    for (const Kind kind : kinds) {
      const FrequencyDifferences found = differentiate_frequencies(design, pose, {.kind = kind}, 4);
      BOOST_TEST_REQUIRE(found.outcome.solved());
      sum += parameter_value(design, {.kind = kind}) * found.derivative;
      frequency = found.frequency;
    }
    for (Index n = 0; n < 4; ++n) BOOST_TEST(std::abs(sum[n] / (degree * frequency[n]) - 1) < 1e-8);
  }
}

BOOST_AUTO_TEST_CASE(difference_quotients_are_of_first_and_second_order) {
  const ManipulatorDesign design = coarse_design();
  const Pose pose{0.26, 0.15, 0.1};
  const DesignParameter thickness = all(Kind::thickness);
  const VectorXd exact = frequency_sensitivity(design, pose, {thickness}, 4).derivative.col(0);
  const auto error = [&](double step, bool central) {
    const FrequencyDifferences found =
        difference_quotient(design, pose, thickness, 4, step, central);
    return (found.derivative - exact).norm() / exact.norm();
  };
  BOOST_TEST(std::abs(std::log2(error(2e-3, true) / error(1e-3, true)) - 2) < 0.05);
  BOOST_TEST(std::abs(std::log2(error(2e-4, false) / error(1e-4, false)) - 1) < 0.05);
}

BOOST_AUTO_TEST_CASE(repeated_frequencies_leave_each_other_along_their_directional_derivatives) {
  const ManipulatorDesign design = coarse_design();
  for (const double phi : {0.0, 0.2}) {
    const Pose pose = centred_pose(phi);
    const DesignParameter parameter = one_length(0, false);
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, 6);
    const VectorXd extrapolated = differentiate_frequencies(design, pose, parameter, 6).derivative;
    const double size = s.derivative.col(0).cwiseAbs().maxCoeff();
    BOOST_TEST((s.derivative.col(0) - extrapolated).cwiseAbs().maxCoeff() < 1e-8 * size);
  }
}

BOOST_AUTO_TEST_CASE(at_a_straight_limb_only_its_own_lengths_change_frequencies_infinitely_fast) {
  // every derivative there was once called infinite, that of E too
  ManipulatorDesign design = coarse_design();
  const Pose pose{0.25, 0.144, 0};
  const Posture posture = inverse_kinematics(design.geometry, pose);
  const double r = (posture.C[0] - design.geometry.base[0]).norm();
  design.geometry.proximal[0] = design.geometry.distal[0] = r / 2;
  const FrequencySensitivity s =
      frequency_sensitivity(design, pose, {all(Kind::E), one_length(1, true)}, 4);
  BOOST_TEST_REQUIRE(s.outcome.solved(), s.outcome.reason);
  const VectorXd differences =
      differentiate_frequencies(design, pose, one_length(1, true), 4).derivative;
  for (Index n = 0; n < 4; ++n) {
    BOOST_TEST(std::abs(s.derivative(n, 0) * 2 * 6.9e10 / s.frequency[n] - 1) < 1e-11);
    BOOST_TEST(std::abs(s.derivative(n, 1) - differences[n]) <
               1e-7 * s.derivative.col(1).cwiseAbs().maxCoeff());
  }
}

BOOST_AUTO_TEST_CASE(what_a_design_lacks_has_no_value_and_none_is_changed_but_what_is_named) {
  ManipulatorDesign design = coarse_design();  // triangles, no springs
  for (Vector2d& corner : design.geometry.base) corner += Vector2d(1, 2);
  for (const Kind kind : {Kind::platform_inertia, Kind::active_stiffness, Kind::elbow_stiffness,
                          Kind::platform_joint_stiffness})
    BOOST_TEST(parameter_value(design, {.kind = kind}) == 0);
  const Pose pose{0.27, 0.15, 0.1};
  const DesignInPose wider = perturbed(design, pose, {.kind = Kind::base_side}, 0.1);
  BOOST_TEST((wider.design.geometry.base[0] - Vector2d(1, 2)).norm() == 0);
  BOOST_TEST((wider.design.geometry.base[1] - Vector2d(1.6, 2)).norm() < 1e-15);
  BOOST_TEST(wider.pose.phi == pose.phi);
  const DesignInPose turned = perturbed(design, pose, {.kind = Kind::orientation}, 0.2);
  BOOST_TEST(turned.pose.phi == pose.phi + 0.2);
  BOOST_TEST(turned.design.geometry.base[1] == design.geometry.base[1]);
}

BOOST_AUTO_TEST_SUITE_END()
