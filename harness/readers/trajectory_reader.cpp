#include "harness/readers/trajectory_reader.h"

#include "harness/base/text.h"

namespace trammel::harness {
namespace {

solver::Pose read_pose(const JsonView& pose) {
  return {pose.number("x_m"), pose.number("y_m"), pose.number("phi_rad")};
}

solver::Circle read_circle(const JsonView& circle) {
  const JsonView center = circle["center_m"];
  return {{center[0].get<double>(), center[1].get<double>()},
          circle.number("radius_m"),
          circle.get("angular_speed_rad_s", 1.0),
          circle.get("phi_rad", 0.0)};
}

solver::Spline read_spline(const JsonView& spline) {
  std::vector<double> times;
  std::vector<solver::Pose> poses;
  for (const auto& [index, knot] : spline["knots"].entries()) {
    times.push_back(knot.number("time_s"));
    poses.push_back(read_pose(knot));
  }
  if (times.front() != 0) {
    throw spline["knots"][0].error("expected the first knot at 0 s (got " +
                                   shortest(times.front()) + " s)");
  }
  const std::string ends = spline.get<std::string>("ends", "natural");
  return solver::make_spline(times, poses,
                             ends == "periodic"  ? solver::SplineEnds::periodic
                             : ends == "at-rest" ? solver::SplineEnds::at_rest
                                                 : solver::SplineEnds::natural);
}

solver::Path read_path(const std::string& kind, const JsonView& place) {
  if (kind == "circle") return read_circle(place);
  if (kind == "spline") return read_spline(place);
  const solver::Pose from = read_pose(place["from"]);
  const solver::Pose to = read_pose(place["to"]);
  const double duration = place.number("duration_s");
  if (kind == "line") return solver::Line{from, to, duration};
  return solver::RestToRest{from, to, duration};
}

}  // namespace

Trajectory read_trajectory(const JsonView& trajectory) {
  const auto [kind, place] = trajectory.entries().front();
  try {
    const solver::Path path = read_path(kind, place);
    return {path,
            solver::sample(path, place["points"].get<solver::Index>(), place.number("step_s"))};
  } catch (const solver::ModelError& error) {
    throw place.error(std::string("expected a path that has a meaning: ") + error.what());
  }
}

}  // namespace trammel::harness
