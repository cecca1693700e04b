#include "solver/manipulator/sensitivity_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace trammel::solver {

FirstFrequency first_frequency(const ManipulatorDesign& design, const DesignParameter& parameter,
                               const Pose& pose) {
  FirstFrequency first{
      .outcome = {}, .evidence = {}, .frequency = kNaN, .derivative = kNaN, .counters = {}};
  for (Index count = 1;; count *= 2) {
    const FrequencySensitivity s = frequency_sensitivity(design, pose, {parameter}, count);
    first.counters += s.counters;
    first.outcome = s.outcome;
    first.evidence = s.evidence;
    const auto rigid = (s.frequency.array() == 0).count();
    if (rigid < s.frequency.size()) {
      first.frequency = s.frequency[rigid];
      first.derivative = s.derivative(rigid, 0);
      return first;
    }
    if (rigid < count) break;
  }
  if (first.outcome.solved()) first.outcome = {Status::singular, "all modes are rigid-body modes"};
  return first;
}

SensitivityMap map_first_frequency(const ManipulatorDesign& design,
                                   const DesignParameter& parameter, const PoseGrid& grid) {
  SensitivityMap map;
  map.grid = grid;
  for (Eigen::MatrixXd* m : {&map.frequency, &map.derivative, &map.serial_distance})
    m->setConstant(grid.rows, grid.columns, kNaN);
  for (Index j = 0; j < grid.rows; ++j) {
    for (Index i = 0; i < grid.columns; ++i) {
      const Pose pose = grid.pose(j, i);
      const Posture posture = inverse_kinematics(design.geometry, pose);
      if (!posture.outcome.solved()) continue;
      map.serial_distance(j, i) = jacobians(design.geometry, pose, posture).serial_distance;
      const FirstFrequency first = first_frequency(design, parameter, pose);
      map.frequency(j, i) = first.frequency;
      map.derivative(j, i) = first.derivative;
      map.counters += first.counters;
      if (first.outcome.solved()) map.evidence.add(first.evidence);
    }
  }
  return map;
}

namespace {

/// Region of positions of the platform point P that a limb can reach: the ring between two
/// concentric circles.
struct Annulus {
  Vector2d center;
  double inner = 0, outer = 0;
};

std::array<Annulus, 3> reach_annuli(const ManipulatorGeometry& g, double phi) {
  const Eigen::Rotation2Dd turn(phi);
  std::array<Annulus, 3> all;
  for (std::size_t i = 0; i < 3; ++i)
    all[i] = {g.base[i] - turn * g.platform[i], std::abs(g.proximal[i] - g.distal[i]),
              g.proximal[i] + g.distal[i]};
  return all;
}

bool in_reach_of_others(const std::array<Annulus, 3>& all, const Annulus& own, const Vector2d& P) {
  return std::ranges::all_of(all, [&](const Annulus& limb) {
    const double r = (P - limb.center).norm();
    return &limb == &own || (r >= limb.inner && r <= limb.outer);
  });
}

void add_arcs(const std::array<Annulus, 3>& all, const Annulus& own, double radius, Index points,
              std::vector<Polyline>& arcs) {
  Polyline arc;
  for (Index k = 0; k <= points && radius > 0; ++k) {
    const auto angle = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points);
    const Vector2d P = own.center + radius * Vector2d(std::cos(angle), std::sin(angle));
    if (in_reach_of_others(all, own, P)) {
      arc.push_back(P);
    } else if (!arc.empty()) {
      arcs.push_back(std::exchange(arc, {}));
    }
  }
  if (!arc.empty()) arcs.push_back(std::move(arc));
}

/// Finds the parallel singularity, where det J_x = 0, on the line between the positions `from` and
/// `to`. The values of the determinant of the Jacobian matrix J_x at these positions, `a` and `b`,
/// have opposite signs. Returns an empty value if a limb cannot reach a point of the line.
std::optional<Vector2d> crossing(const ManipulatorGeometry& geometry, double phi,
                                 const Vector2d& from, const Vector2d& to, double a, double b) {
  std::uintmax_t evaluations = 100;
  bool left = false;
  const auto along = [&](double t) {
    const Vector2d P = from + t * (to - from);
    const double value = parallel_determinant(geometry, {P.x(), P.y(), phi});
    left = left || std::isnan(value);
    // The value 0 ends the search of toms748_solve at once.
    return left ? 0.0 : value;
  };
  const auto ends = boost::math::tools::toms748_solve(
      along, 0.0, 1.0, a, b, boost::math::tools::eps_tolerance<double>(), evaluations);
  if (left) return std::nullopt;
  return from + (ends.first + ends.second) / 2 * (to - from);
}

}  // namespace

std::vector<Polyline> workspace_boundary(const ManipulatorGeometry& geometry, double phi,
                                         Index points) {
  check_geometry(geometry);
  const std::array<Annulus, 3> all = reach_annuli(geometry, phi);
  std::vector<Polyline> arcs;
  for (const Annulus& limb : all) {
    for (const double radius : {limb.outer, limb.inner}) add_arcs(all, limb, radius, points, arcs);
  }
  return arcs;
}

PoseGrid reachable_grid(const ManipulatorGeometry& geometry, double phi, Index columns) {
  check_geometry(geometry);
  if (columns < 2) throw ModelError("a grid of poses must have at least two columns");
  Vector2d low = Vector2d::Constant(-std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const Annulus& limb : reach_annuli(geometry, phi)) {
    low = low.cwiseMax((limb.center.array() - limb.outer).matrix());
    high = high.cwiseMin((limb.center.array() + limb.outer).matrix());
  }
  const Vector2d size = high - low;
  if (!(size.minCoeff() > 0))
    throw ModelError("no pose of this orientation is within reach of the three limbs");
  const double step = size.x() / static_cast<double>(columns - 1);
  const auto rows = static_cast<Index>(std::floor(size.y() / step * (1 + 1e-12))) + 1;
  return {low.x(), low.y(), step, step, columns, rows, phi};
}

std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                             const PoseGrid& grid) {
  Eigen::MatrixXd value(grid.rows, grid.columns);
  for (Index j = 0; j < grid.rows; ++j) {
    for (Index i = 0; i < grid.columns; ++i)
      value(j, i) = parallel_determinant(geometry, grid.pose(j, i));
  }
  std::vector<Polyline> segments;
  for (Index j = 0; j + 1 < grid.rows; ++j) {
    for (Index i = 0; i + 1 < grid.columns; ++i) {
      // Search the four sides of the grid cell for zeros of the determinant of the Jacobian matrix
      // J_x. A cell with a saddle point of det J_x may have four zeros, which are the ends of two
      // segments.
      const std::array<Index, 4> di = {0, 1, 1, 0};
      const std::array<Index, 4> dj = {0, 0, 1, 1};
      Polyline crossings;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        const double a = value(j + dj[k], i + di[k]);
        const double b = value(j + dj[next], i + di[next]);
        if (!((a < 0 && b >= 0) || (a >= 0 && b < 0))) continue;
        const Vector2d from = grid.pose(j + dj[k], i + di[k]).position();
        const Vector2d to = grid.pose(j + dj[next], i + di[next]).position();
        const std::optional<Vector2d> zero = crossing(geometry, grid.phi, from, to, a, b);
        if (zero) crossings.push_back(*zero);
      }
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
        segments.push_back({crossings[k], crossings[k + 1]});
    }
  }
  return segments;
}

}  // namespace trammel::solver
