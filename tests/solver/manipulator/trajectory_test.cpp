#include "solver/manipulator/trajectory.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

BOOST_AUTO_TEST_SUITE(trajectory)

namespace {

using namespace trammel::solver;
using boost::test_tools::tolerance;

constexpr double kPi = std::numbers::pi;

Vector3d as_vector(const Pose& p) {
  return {p.x, p.y, p.phi};
}

/// Compares velocity and acceleration with central differences of pose and velocity.
void check_derivatives(const Path& path, double t, double h, double tolerance) {
  const TrajectoryPoint before = at(path, t - h);
  const TrajectoryPoint now = at(path, t);
  const TrajectoryPoint after = at(path, t + h);
  const Vector3d v = (as_vector(after.pose) - as_vector(before.pose)) / (2 * h);
  const Vector3d a = (after.velocity - before.velocity) / (2 * h);
  BOOST_TEST((v - now.velocity).norm() < tolerance);
  BOOST_TEST((a - now.acceleration).norm() < tolerance);
}

const Pose kFrom{0.2, 0.1, -0.1};
const Pose kTo{0.3, 0.15, 0.4};

}  // namespace

BOOST_AUTO_TEST_CASE(velocity_and_acceleration_are_derivatives) {
  check_derivatives(Circle{{0.25, 0.144}, 0.01, 3, 0.1}, 0.4, 1e-4, 1e-8);
  check_derivatives(Line{kFrom, kTo, 2}, 0.4, 1e-3, 1e-12);
  check_derivatives(RestToRest{kFrom, kTo, 2}, 0.4, 1e-4, 1e-7);
  check_derivatives(
      make_spline({0, 0.5, 0.8, 2}, {kFrom, kTo, {0.1, 0.2, 0}, kFrom}, SplineEnds::natural), 0.6,
      1e-4, 1e-5);
}

BOOST_AUTO_TEST_CASE(rest_to_rest_motion_starts_and_ends_at_rest) {
  const Path path = RestToRest{kFrom, kTo, 2};
  for (const double t : {-1.0, 0.0, 2.0, 5.0}) {
    BOOST_TEST(at(path, t).velocity.norm() == 0.0);
    BOOST_TEST(at(path, t).acceleration.norm() == 0.0);
  }
  BOOST_TEST((as_vector(at(path, 2).pose) - as_vector(kTo)).norm() < 1e-16);
  // The motion is symmetric about the middle of its duration, where the speed is 15/8 of the mean
  // speed.
  const Vector3d mean = (as_vector(kTo) - as_vector(kFrom)) / 2;
  BOOST_TEST((at(path, 1).velocity - 15.0 / 8 * mean).norm() < 1e-15);
  BOOST_TEST((at(path, 0.5).velocity - at(path, 1.5).velocity).norm() < 1e-15);
}

BOOST_AUTO_TEST_CASE(spline_reproduces_a_cubic) {
  // x = t^3 - 3 t^2 on [0, 2] starts and ends at rest. A spline with ends at rest must reproduce
  // this cubic.
  const auto cubic = [](double t) { return t * t * (t - 3); };
  const std::vector<double> times{0, 0.3, 0.9, 1.2, 2};
  std::vector<Pose> poses;
  poses.reserve(times.size());
  for (const double t : times) poses.push_back({cubic(t), 2 * cubic(t), 1});
  const Path path = make_spline(times, poses, SplineEnds::at_rest);
  for (int k = 0; k <= 40; ++k) {
    const double t = 0.05 * k;
    const TrajectoryPoint p = at(path, t);
    BOOST_TEST(std::abs(p.pose.x - cubic(t)) < 1e-14);
    BOOST_TEST(std::abs(p.velocity.y() - 2 * (3 * t * t - 6 * t)) < 1e-13);
    BOOST_TEST(std::abs(p.acceleration.x() - (6 * t - 6)) < 1e-13);
    BOOST_TEST(p.pose.phi == 1, tolerance(1e-15));
  }
}

BOOST_AUTO_TEST_CASE(periodic_spline_converges_with_order_4) {
  const Circle circle{{0.25, 0.144}, 0.01};
  double last = 0;
  for (const int n : {16, 32, 64}) {
    std::vector<double> times;
    std::vector<Pose> poses;
    for (int k = 0; k <= n; ++k) {
      times.push_back(2 * kPi * k / n);
      poses.push_back(k == n ? poses.front() : at(circle, times.back()).pose);
    }
    const Path path = make_spline(times, poses, SplineEnds::periodic);
    double worst = 0;
    for (int k = 0; k <= 628; ++k) {
      const double t = 0.01 * k;
      worst = std::max(worst, (as_vector(at(path, t).pose) - as_vector(at(circle, t).pose)).norm());
    }
    if (last > 0) BOOST_TEST(std::abs(std::log2(last / worst) - 4) < 0.1);  // theoretical order: 4
    last = worst;
    BOOST_TEST((at(path, times.front()).velocity - at(path, times.back()).velocity).norm() < 1e-15);
  }
}

BOOST_AUTO_TEST_CASE(last_sample_reaches_the_end_despite_round_off) {
  const Spline spline =
      make_spline({0, 2, 6.3}, {{0.25, 0.14}, {0.26, 0.15}, {0.24, 0.15}}, SplineEnds::natural);
  BOOST_TEST(63 * 0.1 > 6.3);
  const std::vector<TrajectoryPoint> points = sample(spline, 64, 0.1);
  BOOST_TEST(points.back().pose.x == 0.24, tolerance(1e-15));
  BOOST_CHECK_THROW((void)sample(spline, 65, 0.1), ModelError);
}

BOOST_AUTO_TEST_CASE(invalid_paths_are_refused) {
  const double nan = std::nan("");
  const std::vector<Pose> three{kFrom, kTo, kFrom};
  const auto natural = [](const std::vector<double>& times, const std::vector<Pose>& poses) {
    return make_spline(times, poses, SplineEnds::natural);
  };
  BOOST_CHECK_THROW((void)at(Circle{{0, 0}, -1}, 0), ModelError);
  BOOST_CHECK_THROW((void)at(Circle{{nan, 0}, 1}, 0), ModelError);
  BOOST_CHECK_THROW((void)at(Circle{{0, 0}, 1}, nan), ModelError);
  BOOST_CHECK_THROW((void)at(Line{kFrom, kTo, 0}, 0), ModelError);
  BOOST_CHECK_THROW((void)at(RestToRest{kFrom, {nan, 0, 0}, 1}, 0), ModelError);
  BOOST_CHECK_THROW((void)sample(Circle{{0, 0}, 1}, 0, 0.1), ModelError);
  BOOST_CHECK_THROW((void)sample(Circle{{0, 0}, 1}, 5, 0), ModelError);
  BOOST_CHECK_THROW((void)natural({0, 1}, {kFrom, kTo}), ModelError);
  BOOST_CHECK_THROW((void)natural({0, 1, 1}, three), ModelError);
  BOOST_CHECK_THROW((void)natural({0, 1, nan}, three), ModelError);
  BOOST_CHECK_THROW((void)make_spline({0, 1, 2}, {kFrom, kTo, kTo}, SplineEnds::periodic),
                    ModelError);
  BOOST_CHECK_THROW((void)at(natural({0, 1, 2}, three), 2.1), ModelError);
}

BOOST_AUTO_TEST_CASE(path_is_at_rest_only_if_it_never_moves) {
  BOOST_TEST(is_at_rest(Circle{{0.25, 0.144}, 0, 1}));
  BOOST_TEST(is_at_rest(Circle{{0.25, 0.144}, 0.01, 0}));
  BOOST_TEST(!is_at_rest(Circle{{0.25, 0.144}, 0.01, 1}));
  BOOST_TEST(is_at_rest(Line{kFrom, kFrom, 1}));
  BOOST_TEST(!is_at_rest(Line{kFrom, kTo, 1}));
  BOOST_TEST(is_at_rest(RestToRest{kTo, kTo, 1}));
  BOOST_TEST(!is_at_rest(RestToRest{kFrom, kTo, 1}));  // at rest before 0 and after 1 s
  BOOST_TEST(is_at_rest(make_spline({0, 1, 2}, {kTo, kTo, kTo}, SplineEnds::at_rest)));
  BOOST_TEST(!is_at_rest(make_spline({0, 1, 2}, {kTo, kFrom, kTo}, SplineEnds::at_rest)));
}

BOOST_AUTO_TEST_SUITE_END()
