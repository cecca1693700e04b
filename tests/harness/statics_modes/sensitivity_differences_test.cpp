#include <boost/test/unit_test.hpp>
#include <cmath>

#include "harness/statics_modes/frequency_differences.h"
#include "tests/support/solver/sensitivity_designs.h"

BOOST_AUTO_TEST_SUITE(sensitivity_differences)

using namespace trammel::solver;
using namespace trammel::harness;

/// A frequency is proportional to the square root of all stiffnesses, and inversely proportional to
/// the square root of all masses and inertias.
BOOST_AUTO_TEST_CASE(sums_of_derivatives_agree_with_dimensional_analysis) {
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
    for (Index n = 0; n < 4; ++n)
      BOOST_TEST(sum[n] == degree * frequency[n], boost::test_tools::tolerance(1e-8));
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

BOOST_AUTO_TEST_CASE(straight_limb_has_infinite_derivatives_by_its_lengths) {
  // With a straight limb, all derivatives of frequencies were once reported as infinite, even those
  // with respect to the elastic modulus E.
  ManipulatorDesign design = coarse_design();
  const Pose pose{0.25, 0.144, 0};
  const Vector2d C = inverse_kinematics(design.geometry, pose).C[0];
  const double r = (C - design.geometry.base[0]).norm();
  design.geometry.proximal[0] = design.geometry.distal[0] = r / 2;
  const FrequencySensitivity s =
      frequency_sensitivity(design, pose, {all(Kind::E), length_parameter(1, true)}, 4);
  BOOST_TEST_REQUIRE(s.outcome.solved(), s.outcome.reason);
  const VectorXd differences =
      differentiate_frequencies(design, pose, length_parameter(1, true), 4).derivative;
  for (Index n = 0; n < 4; ++n) {
    BOOST_TEST(s.derivative(n, 0) * 2 * 6.9e10 == s.frequency[n],
               boost::test_tools::tolerance(1e-11));
    BOOST_TEST(std::abs(s.derivative(n, 1) - differences[n]) <
               1e-7 * s.derivative.col(1).cwiseAbs().maxCoeff());
  }
  const Outcome own = frequency_sensitivity(design, pose, {length_parameter(0, true)}, 4).outcome;
  BOOST_TEST(own.reason.find("straight") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(only_the_named_parameter_is_perturbed) {
  ManipulatorDesign design = coarse_design();  // triangular elements, no springs
  for (Vector2d& corner : design.geometry.base) corner += Vector2d(1, 2);
  for (const Kind kind : {Kind::platform_inertia, Kind::active_stiffness, Kind::elbow_stiffness,
                          Kind::platform_joint_stiffness})
    BOOST_TEST(parameter_value(design, {.kind = kind}) == 0);
  const Pose pose{0.27, 0.15, 0.1};
  const DesignInPose wider = perturb_design(design, pose, {.kind = Kind::base_side}, 0.1);
  BOOST_TEST((wider.design.geometry.base[0] - Vector2d(1, 2)).norm() == 0);
  BOOST_TEST((wider.design.geometry.base[1] - Vector2d(1.6, 2)).norm() < 1e-15);
  BOOST_TEST(wider.pose.phi == pose.phi);
  const DesignInPose turned = perturb_design(design, pose, {.kind = Kind::orientation}, 0.2);
  BOOST_TEST(turned.pose.phi == pose.phi + 0.2);
  BOOST_TEST(turned.design.geometry.base[1] == design.geometry.base[1]);
}

BOOST_AUTO_TEST_SUITE_END()
