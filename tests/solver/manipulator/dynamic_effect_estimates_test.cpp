#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "solver/linear/modes.h"
#include "solver/manipulator/effect_estimates.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(dynamic_effect_estimates)

using namespace trammel::solver;
using std::numbers::pi;

namespace {

/// A circle so small that the pose stays: loads of inertia turn at its speed, and so do responses.
ElastodynamicsOptions on_small_circle(double speed) {
  ElastodynamicsOptions options;
  options.design = table_1_design();
  options.design.platform.kind = PlatformKind::rigid;
  for (std::size_t i = 0; i < 3; ++i)
    options.design.proximal[i].elements = options.design.distal[i].elements = 1;
  options.path = Circle{.center = {0.25, 0.144}, .radius = 1e-6, .angular_speed = speed, .phi = 0};
  options.damping = {.mass = 0, .stiffness = 0};
  options.time.end = 2 * pi / speed;
  options.time.quasi_static_start = true;
  for (int i = 0; i < 12; ++i) options.time.sample_times.push_back(i * options.time.end / 12);
  return options;
}

System system_at_centre(const ElastodynamicsOptions& options) {
  return assemble(build_manipulator(options.design, at(options.path, 0).pose));
}

double first_angular_frequency(const ElastodynamicsOptions& options) {
  return 2 * pi * solve_modes(system_at_centre(options), {.count = 1}).frequency[0];
}

EffectEstimate estimate_of(const ElastodynamicsOptions& options, Effect effect) {
  const EffectEstimates found = estimate_motion_effects(options, Effects().with(effect));
  BOOST_TEST_REQUIRE(found.outcome.solved(), found.outcome.reason);
  return found.effects.at(0);
}

const auto kPoseStays = boost::test_tools::tolerance(1e-4);

}  // namespace

BOOST_AUTO_TEST_CASE(damping_by_stiffness_delays_a_slow_response_by_its_time) {
  // K q + b K q. = f: of q, b times the speed; then as the first mode amplifies it, and once more
  // as what starts on q swings half a period later
  ElastodynamicsOptions options = on_small_circle(20);
  const double b = options.damping.stiffness = 1e-3;
  const double omega = first_angular_frequency(options), ratio = b * omega / 2, r = 20 / omega;
  const double amplified = 1 / std::hypot(1 - r * r, 2 * ratio * r);
  const EffectEstimate damping = estimate_of(options, Effect::damping);
  BOOST_TEST(damping.change == b * 20 * amplified * (1 + std::exp(-pi * ratio)), kPoseStays);
  BOOST_TEST(damping.number == ratio, kPoseStays);
}

BOOST_AUTO_TEST_CASE(elastic_inertia_grows_with_the_square_of_the_speed) {
  std::vector<double> change;
  for (const double speed : {10.0, 20.0}) {
    const ElastodynamicsOptions options = on_small_circle(speed);
    const EffectEstimate inertia = estimate_of(options, Effect::inertia);
    const double number = std::pow(speed / first_angular_frequency(options), 2);
    BOOST_TEST(inertia.number == number, kPoseStays);
    change.push_back(inertia.change * (1 - number));  // amplified by 1 / (1 - r^2)
  }
  BOOST_TEST(change[1] / change[0] == 4, kPoseStays);
}

BOOST_AUTO_TEST_CASE(the_only_masses_and_the_only_weights_are_worth_the_whole_response) {
  ElastodynamicsOptions options = on_small_circle(20);
  options.design.platform.material.rho = 1e-9;
  const double amplified = 1 / (1 - std::pow(20 / first_angular_frequency(options), 2));
  BOOST_TEST(estimate_of(options, Effect::link_mass).change == amplified, kPoseStays);
  options.time.quasi_static_start = false;  // and nothing is left that could vibrate
  BOOST_TEST(estimate_of(options, Effect::link_mass).change > 2);
  options = on_small_circle(20);
  options.gravity = {0, -9.81};
  const EffectEstimate weight = estimate_of(options, Effect::gravity);
  BOOST_TEST(weight.change == 1 / (1 - std::pow(20 / first_angular_frequency(options), 2)),
             boost::test_tools::tolerance(1e-3));  // inertia adds 4e-5 of g
}

BOOST_AUTO_TEST_CASE(links_alone_have_all_kinetic_energy_in_translation_and_turning_of_sections) {
  ElastodynamicsOptions options = on_small_circle(20);
  options.design.platform.material.rho = 1e-9;
  for (auto* links : {&options.design.proximal, &options.design.distal}) {
    for (LinkDesign& link : *links) {
      link.thickness = 0.03;
      link.theory = BeamTheory::timoshenko;
    }
  }
  const double link_mass = estimate_of(options, Effect::link_mass).number;
  const double rotary = estimate_of(options, Effect::rotary_inertia).number;
  BOOST_TEST(rotary > 1e-3);
  BOOST_TEST(link_mass + rotary == 1, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(gyroscopic_forces_go_by_twice_the_rate_of_the_links) {
  const ElastodynamicsOptions options = on_small_circle(20);
  double rate = 0;
  for (const double time : options.time.sample_times) {
    rate =
        std::max(rate, inverse_dynamics(rigid_manipulator(options.design), at(options.path, time))
                           .q_dot.cwiseAbs()
                           .maxCoeff());
  }
  BOOST_TEST(
      estimate_of(options, Effect::gyroscopic).number ==
          2 * rate / first_angular_frequency(options),
      boost::test_tools::tolerance(2e-3));  // rates are seen 1e-3 rad beside the samples, too
}

BOOST_AUTO_TEST_CASE(large_displacement_is_bounded_by_the_buckling_of_a_limb) {
  for (const bool flexible : {true, false}) {  // constraints bear what inextensible links do
    ElastodynamicsOptions options = on_small_circle(0.01);
    options.wrench = {0, 1, 0};
    for (auto* links : {&options.design.proximal, &options.design.distal})
      for (LinkDesign& link : *links) link.axially_flexible = flexible;
    Model model = build_manipulator(options.design, at(options.path, 0).pose);
    model.loads.push_back({model.find_node("P"), options.wrench});
    const double force =
        solve_statics(assemble(model)).resultant_start.col(0).cwiseAbs().maxCoeff();
    const double buckling = pi * pi * model.members[0].section.EI / (0.2 * 0.2);
    const EffectEstimates found = estimate_motion_effects(options, Effects().with(Effect::inertia));
    BOOST_TEST(found.large_displacement_bound == 16 * force / buckling, kPoseStays);
  }
}

BOOST_AUTO_TEST_CASE(rates_at_the_ends_of_a_table_of_poses_are_taken_within_it) {
  ElastodynamicsOptions circle = on_small_circle(20);
  circle.time.sample_times.push_back(circle.time.end);
  circle.damping.stiffness = 1e-3;
  ElastodynamicsOptions table = circle;
  std::vector<double> times;
  std::vector<Pose> poses;
  for (int i = 0; i <= 64; ++i) {
    times.push_back(i * circle.time.end / 64);
    poses.push_back(at(circle.path, times.back()).pose);
  }
  poses.back() = poses.front();
  table.path = make_spline(times, poses, SplineEnds::periodic);
  BOOST_TEST(
      estimate_of(table, Effect::damping).change == estimate_of(circle, Effect::damping).change,
      boost::test_tools::tolerance(1e-2));
}

BOOST_AUTO_TEST_SUITE_END()
