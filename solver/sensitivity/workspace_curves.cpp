#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "solver/sensitivity/sensitivity_map.h"

namespace trammel::solver {
namespace {

/// Positions of P that the limb reaches: between two circles about one centre.
struct Annulus {
  Vector2d center;
  double inner = 0, outer = 0;
};

std::array<Annulus, 3> reach_annuli(const ManipulatorGeometry& g, double phi) {
  const Eigen::Rotation2Dd turn(phi);
  std::array<Annulus, 3> all;
  for (std::size_t i = 0; i < 3; ++i) {
    all[i] = {g.base[i] - turn * g.platform[i], std::abs(g.proximal[i] - g.distal[i]),
              g.proximal[i] + g.distal[i]};
  }
  return all;
}

bool reached_by_others(const std::array<Annulus, 3>& all, std::size_t own, const Vector2d& P) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == own) continue;
    const double r = (P - all[i].center).norm();
    if (r < all[i].inner || r > all[i].outer) return false;
  }
  return true;
}

void add_arcs(const std::array<Annulus, 3>& all, std::size_t own, double radius, Index points,
              std::vector<Polyline>& arcs) {
  if (radius == 0) return;
  Polyline arc;
  for (Index k = 0; k <= points; ++k) {
    const double angle =
        2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(points);
    const Vector2d P = all[own].center + radius * Vector2d(std::cos(angle), std::sin(angle));
    if (reached_by_others(all, own, P)) {
      arc.push_back(P);
    } else if (!arc.empty()) {
      arcs.push_back(std::move(arc));
      arc.clear();
    }
  }
  if (!arc.empty()) arcs.push_back(std::move(arc));
}

/// det J_x [m^4]; NaN out of reach.
double determinant(const ManipulatorGeometry& geometry, const Pose& pose) {
  const Posture posture = inverse_kinematics(geometry, pose);
  if (!posture.outcome.solved()) return std::numeric_limits<double>::quiet_NaN();
  return jacobians(geometry, pose, posture).parallel.determinant();
}

/// det J_x = 0 between two places where its signs, `a` and `b`, differ; nothing where the way from
/// one to the other leaves the reach.
std::optional<Vector2d> crossing(const ManipulatorGeometry& geometry, double phi,
                                 const Vector2d& from, const Vector2d& to, double a, double b) {
  std::uintmax_t evaluations = 100;
  bool left = false;
  const auto along = [&](double t) {
    const Vector2d P = from + t * (to - from);
    const double value = determinant(geometry, {P.x(), P.y(), phi});
    left = left || std::isnan(value);
    return left ? 0.0 : value;  // 0 ends the search
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
  for (std::size_t i = 0; i < 3; ++i) {
    add_arcs(all, i, all[i].outer, points, arcs);
    add_arcs(all, i, all[i].inner, points, arcs);
  }
  return arcs;
}

std::vector<Polyline> parallel_singularities(const ManipulatorGeometry& geometry,
                                             const PoseGrid& grid) {
  Eigen::MatrixXd value(grid.rows, grid.columns);
  const auto at = [&](Index i, Index j) { return Vector2d(grid.pose(j, i).x, grid.pose(j, i).y); };
  for (Index j = 0; j < grid.rows; ++j) {
    for (Index i = 0; i < grid.columns; ++i) value(j, i) = determinant(geometry, grid.pose(j, i));
  }
  std::vector<Polyline> segments;
  for (Index j = 0; j + 1 < grid.rows; ++j) {
    for (Index i = 0; i + 1 < grid.columns; ++i) {
      // around the cell; a saddle, with four crossings, gives two segments
      const std::array<Index, 4> di = {0, 1, 1, 0};
      const std::array<Index, 4> dj = {0, 0, 1, 1};
      Polyline crossings;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4;
        const double a = value(j + dj[k], i + di[k]);
        const double b = value(j + dj[next], i + di[next]);
        if (!((a < 0 && b >= 0) || (a >= 0 && b < 0))) continue;
        const Vector2d from = at(i + di[k], j + dj[k]);
        const Vector2d to = at(i + di[next], j + dj[next]);
        const std::optional<Vector2d> zero = crossing(geometry, grid.phi, from, to, a, b);
        if (zero) crossings.push_back(*zero);
      }
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
        segments.push_back({crossings[k], crossings[k + 1]});
      }
    }
  }
  return segments;
}

}  // namespace trammel::solver
