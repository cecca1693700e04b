#include "solver/manipulator/elastodynamics.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "tests/support/solver/equal_statics.h"
#include "tests/support/solver/table_1.h"

BOOST_AUTO_TEST_SUITE(elastodynamics)

using namespace trammel::solver;
using boost::test_tools::tolerance;
using Eigen::VectorXd;

namespace {

ManipulatorDesign coarse_design(PlatformKind platform = PlatformKind::rigid) {
  return meshed_design(2, platform);
}

Circle circle(double angular_speed) {
  return {.center = {0.25, 0.144}, .radius = 0.01, .angular_speed = angular_speed, .phi = 0};
}

ElastodynamicsOptions options_on_path(const Path& path, double end, double step) {
  ElastodynamicsOptions options;
  options.design = coarse_design();
  options.path = path;
  options.time.end = end;
  options.time.step = step;
  return options;
}

/// Returns a platform at rest for 0.1 s under a force that is applied suddenly.
ElastodynamicsOptions resting(double step) {
  const Pose pose{0.26, 0.15, 0.1};
  ElastodynamicsOptions options = options_on_path(RestToRest{pose, pose, 1}, 0.1, step);
  options.wrench = {10, 0, 0};
  return options;
}

double largest_difference(const ElastodynamicsSolution& a, const ElastodynamicsSolution& b) {
  return (a.deflection - b.deflection).rowwise().norm().maxCoeff();
}

double relative_change(const ElastodynamicsSolution& with, const ElastodynamicsSolution& without) {
  return largest_difference(with, without) / without.deflection.rowwise().norm().maxCoeff();
}

}  // namespace

BOOST_AUTO_TEST_CASE(motion_without_inertia_is_statics_at_every_pose) {
  for (const PlatformKind kind : {PlatformKind::rigid, PlatformKind::triangles}) {
    ElastodynamicsOptions options = options_on_path(circle(1), 6, 1.5);
    options.design = coarse_design(kind);
    options.wrench = {10, 0, 0};
    options.gravity = {0, -9.81};
    options.elastic_inertia = options.nominal_inertia = false;
    const ElastodynamicsSolution motion = solve_elastodynamics(options);
    BOOST_TEST_REQUIRE(motion.outcome.solved(), motion.outcome.reason);
    BOOST_TEST(motion.time.size() == 5U);
    for (std::size_t i = 0; i < motion.time.size(); ++i) {
      const StaticSolution statics =
          solve_statics(assemble(static_model(options, motion.nominal[i])));
      const StaticSolution& state = motion.state[i];
      check_equal_statics(state, statics, 1e-9, 1e-8);
      if (kind == PlatformKind::triangles) {
        BOOST_TEST((state.triangle_stress - statics.triangle_stress).norm() <
                   1e-7 * statics.triangle_stress.norm());
      }
      BOOST_TEST(state.equilibrium_residual < 1e-8);
      BOOST_TEST(state.moment_residual < 1e-8);
    }
  }
}

BOOST_AUTO_TEST_CASE(links_lost_to_round_off_of_a_platform_are_refused) {
  // Under a load of 10 N, a result with an unbalanced force of 384 N once had the status solved.
  ElastodynamicsOptions options = resting(1e-2);
  options.design = coarse_design(PlatformKind::triangles);
  options.modal_superposition = true;
  BOOST_TEST(solve_elastodynamics(options).outcome.solved());
  options.design.platform.material.E = 6.9e19;
  const ElastodynamicsSolution s = solve_elastodynamics(options);
  BOOST_TEST(s.outcome.reason.find("equation of motion") != std::string::npos, s.outcome.reason);
}

BOOST_AUTO_TEST_CASE(time_steps_balance_at_their_ends_between_samples) {
  ElastodynamicsOptions options = resting(1e-2);
  options.design = coarse_design(PlatformKind::triangles);
  options.time.sample_times = {0.033, 0.067};
  BOOST_TEST(solve_elastodynamics(options).outcome.solved());
  options.design.platform.material.E = 6.9e19;
  BOOST_TEST(!solve_elastodynamics(options).outcome.solved());
  // The residual from round-off in a stiff platform is relative to the loads, not to the large
  // internal forces of the platform.
  options.design.platform.material.E = 6.9e15;
  const ElastodynamicsSolution s = solve_elastodynamics(options);
  BOOST_TEST(s.evidence.largest(Residual::equation_of_motion) > 1e-10);
}

BOOST_AUTO_TEST_CASE(matrices_of_a_resting_manipulator_are_factored_once) {
  const ElastodynamicsOptions options = resting(5e-4);
  const ElastodynamicsSolution s = solve_elastodynamics(options);
  BOOST_TEST(s.time.size() == 201U);
  BOOST_TEST(s.summary.counters.factorizations == 3);  // of mass, step and stiffness matrix
}

BOOST_AUTO_TEST_CASE(effects_of_inertia_and_gyroscopic_terms_are_estimated) {
  ElastodynamicsOptions options =
      options_on_path(RestToRest{{0.25, 0.144, 0}, {0.28, 0.15, 0.1}, 0.2}, 0.2, 5e-3);
  options.wrench = {0.1, 0, 0};
  options.elastic_inertia = false;
  const ElastodynamicsSolution with = solve_elastodynamics(options);
  options.nominal_inertia = false;
  const ElastodynamicsSolution without = solve_elastodynamics(options);
  BOOST_TEST(relative_change(with, without) > 1);
  BOOST_TEST(with.effects.nominal_inertia == relative_change(with, without), tolerance(0.5));
  BOOST_TEST(with.effects.nominal_inertia == without.effects.nominal_inertia);

  options = options_on_path(circle(10), 0.3, 1e-3);
  options.wrench = {10, 0, 0};
  options.time.quasi_static_start = true;
  const ElastodynamicsSolution plain = solve_elastodynamics(options);
  options.gyroscopic = true;
  const ElastodynamicsSolution gyroscopic = solve_elastodynamics(options);
  BOOST_TEST(relative_change(gyroscopic, plain) > 0);
  BOOST_TEST(relative_change(gyroscopic, plain) < gyroscopic.effects.gyroscopic);
}

BOOST_AUTO_TEST_CASE(errors_along_and_across_the_path_are_the_deflection) {
  ElastodynamicsOptions options = options_on_path(circle(1), 6, 0.5);
  options.wrench = {10, 0, 0};
  options.elastic_inertia = false;
  const ElastodynamicsSolution s = solve_elastodynamics(options);
  for (std::size_t i = 0; i < s.time.size(); ++i) {
    const auto k = static_cast<Index>(i);
    const Vector2d radial(std::cos(s.time[i]), std::sin(s.time[i]));
    const Vector2d u = s.deflection.row(k);
    // The normal error is positive to the left of the path, toward the center of the circle.
    BOOST_TEST(std::abs(s.normal_error[k] + radial.dot(u)) < 1e-14);
    BOOST_TEST(std::abs(std::hypot(s.normal_error[k], s.tangential_error[k]) - u.norm()) < 1e-14);
  }
}

BOOST_AUTO_TEST_CASE(path_out_of_reach_ends_with_its_time) {
  const Line line{{0.25, 0.144, 0}, {0.25, 0.9, 0}, 1};
  ElastodynamicsOptions options = options_on_path(line, 1, 1e-2);
  for (const bool dynamic : {true, false}) {
    options.elastic_inertia = dynamic;
    const ElastodynamicsSolution s = solve_elastodynamics(options);
    BOOST_TEST((s.outcome.status == Status::singular));
    BOOST_TEST(s.outcome.reason.find("at t = ") != std::string::npos, s.outcome.reason);
    BOOST_TEST(s.outcome.reason.find("reach") != std::string::npos, s.outcome.reason);
    BOOST_TEST(s.time.size() > 3U);
    BOOST_TEST(s.deflection.allFinite());
  }
}

BOOST_AUTO_TEST_CASE(quasi_static_deflection_is_that_without_inertia) {
  for (const PlatformKind kind : {PlatformKind::rigid, PlatformKind::triangles}) {
    ElastodynamicsOptions options = options_on_path(circle(20), 0.05, 1e-3);
    options.design = coarse_design(kind);
    options.wrench = {10, 0, 0};
    options.gyroscopic = true;
    const ElastodynamicsSolution motion = solve_elastodynamics(options);
    options.elastic_inertia = options.gyroscopic = false;
    const ElastodynamicsSolution slow = solve_elastodynamics(options);
    BOOST_TEST((motion.quasi_static_deflection - slow.deflection).norm() <
               1e-12 * slow.deflection.norm());
    BOOST_TEST(largest_difference(motion, slow) > 1e-3 * slow.deflection.norm());
    BOOST_TEST((slow.quasi_static_deflection == slow.deflection));
  }
}

BOOST_AUTO_TEST_CASE(mechanism_has_no_quasi_static_deflection) {
  ElastodynamicsOptions options = options_on_path(circle(20), 0.01, 1e-3);
  options.design.active.fill({ActiveKind::free});
  options.design.elbow.fill({ElbowKind::hinged});
  options.wrench = {10, 0, 0};
  const ElastodynamicsSolution s = solve_elastodynamics(options);
  BOOST_TEST_REQUIRE(s.outcome.solved(), s.outcome.reason);
  BOOST_TEST(std::isnan(s.effects.nominal_inertia));
  BOOST_TEST(s.quasi_static_deflection.array().isNaN().all());
  BOOST_TEST(s.effects.first_frequency > 0);  // the first elastic frequency
}

BOOST_AUTO_TEST_CASE(unsupported_option_combinations_are_refused) {
  const Path line = RestToRest{{0.25, 0.144, 0}, {0.28, 0.15, 0.1}, 0.2};
  const std::vector<std::function<void(ElastodynamicsOptions&)>> changes = {
      [](auto& o) { o.modal_superposition = true; },
      [&](auto& o) {
        o.path = line;  // at rest at the samples only
        o.time.sample_times = {0, 0.2};
        o.modal_superposition = true;
      },
      [](auto& o) {
        o.gyroscopic = true;
        o.elastic_inertia = false;
      },
      [](auto& o) {  // the platform cannot rotate
        o.design = coarse_design(PlatformKind::triangles);
        o.wrench = {0, 0, 1};
      }};
  for (const auto& change : changes) {
    ElastodynamicsOptions options = options_on_path(circle(20), 0.2, 1e-2);
    change(options);
    BOOST_CHECK_THROW(static_cast<void>(solve_elastodynamics(options)), ModelError);
  }
}

BOOST_AUTO_TEST_SUITE_END()
