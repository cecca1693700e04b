#include "solver/elements/platform_mesh.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "solver/elements/triangle_element.h"
#include "solver/model/model.h"

namespace trammel::solver {

namespace {

using Corners = std::array<Vector2d, 3>;

double twice_area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return cross(b - a, c - a);
}

/// Adds the mid-side nodes of all triangles. Two triangles share the node of a common side.
void add_midside_nodes(TriangleMesh& mesh) {
  mesh.nodes.reserve(mesh.nodes.size() + 2 * mesh.triangles.size());
  std::unordered_map<Index, Index> middle;  // mid-side node of the side with given end nodes
  middle.reserve(2 * mesh.triangles.size());
  for (TriangleMesh::Nodes& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [i, j] = std::minmax({t[k], t[(k + 1) % 3]});
      const auto [at, fresh] = middle.try_emplace((i << 32) | j, std::ssize(mesh.nodes));
      if (fresh) mesh.nodes.emplace_back((mesh.nodes[to_size(i)] + mesh.nodes[to_size(j)]) / 2);
      t[3 + k] = at->second;
    }
  }
}

/// Splits every triangle into four triangles at its mid-side nodes.
TriangleMesh split(TriangleMesh mesh) {
  add_midside_nodes(mesh);
  TriangleMesh fine{std::move(mesh.nodes), {}};
  fine.triangles.reserve(4 * mesh.triangles.size());
  for (const auto& [i, j, k, ij, jk, ki] : mesh.triangles) {
    fine.triangles.push_back({i, ij, ki, -1, -1, -1});
    fine.triangles.push_back({ij, j, jk, -1, -1, -1});
    fine.triangles.push_back({ki, jk, k, -1, -1, -1});
    fine.triangles.push_back({ij, jk, ki, -1, -1, -1});
  }
  return fine;
}

/// Point of an integration rule of degree 5 with seven points on a triangle (Radon 1948):
/// barycentric coordinates and weight.
struct RulePoint {
  Vector3d barycentric;
  double weight;
};

const std::array<RulePoint, 7>& radon_rule() {
  static const std::array<RulePoint, 7> rule = [] {
    const double r = std::sqrt(15.0), a = (6 - r) / 21;
    const double b = (6 + r) / 21;
    const double wa = (155 - r) / 1200;
    const double wb = (155 + r) / 1200;
    return std::array<RulePoint, 7>{{{Vector3d::Constant(1.0 / 3), 9.0 / 40},
                                     {{1 - 2 * a, a, a}, wa},
                                     {{a, 1 - 2 * a, a}, wa},
                                     {{a, a, 1 - 2 * a}, wa},
                                     {{1 - 2 * b, b, b}, wb},
                                     {{b, 1 - 2 * b, b}, wb},
                                     {{b, b, 1 - 2 * b}, wb}}};
  }();
  return rule;
}

/// Calls visit(point, area) at quadrature points of the triangle t, for an integral over the disc
/// with center x0. `area` is the quadrature weight of the point [m^2]. The triangle is divided
/// recursively into pieces that are small compared with the disc. Pieces outside the disc are
/// skipped.
template <class Visit>
void visit_disc_points(const Corners& t, const Vector2d& x0, double radius, const Visit& visit) {
  const Vector2d centroid = (t[0] + t[1] + t[2]) / 3;
  double reach = 0;
  for (const Vector2d& corner : t) reach = std::max(reach, (corner - centroid).norm());
  if ((centroid - x0).norm() > radius + reach) return;
  if (reach > radius / 16) {
    const Corners m{(t[0] + t[1]) / 2, (t[1] + t[2]) / 2, (t[2] + t[0]) / 2};
    visit_disc_points({t[0], m[0], m[2]}, x0, radius, visit);
    visit_disc_points({m[0], t[1], m[1]}, x0, radius, visit);
    visit_disc_points({m[2], m[1], t[2]}, x0, radius, visit);
    visit_disc_points(m, x0, radius, visit);
    return;
  }
  const double area = twice_area(t[0], t[1], t[2]) / 2;
  for (const RulePoint& point : radon_rule()) {
    const Vector3d& l = point.barycentric;
    const Vector2d x = l(0) * t[0] + l(1) * t[1] + l(2) * t[2];
    visit(x, point.weight * area);
  }
}

/// Integrals over the area of a pin, from which the weight of each mesh node i follows: int N_i phi
/// (1, xi, eta) dA with (xi, eta) = (x - x0) / radius. N_i is the shape function of the node, and
/// phi is the kernel function defined at `pin_weights`.
using Shares = std::unordered_map<Index, Vector3d>;

void add_node_shares_of_pin(const TriangleMesh& mesh, const TriangleMesh::Nodes& nodes,
                            const Vector2d& x0, double radius, Shares& shares) {
  Corners t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = mesh.nodes[static_cast<std::size_t>(nodes[k])];
  const double whole = twice_area(t[0], t[1], t[2]);
  const bool six_nodes = nodes[3] >= 0;
  // Integrals of N_i phi times 1, xi and eta (columns) for each node i of the triangle (rows).
  Eigen::Matrix<double, 6, 3> moments = Eigen::Matrix<double, 6, 3>::Zero();
  visit_disc_points(t, x0, radius, [&](const Vector2d& x, double area) {
    const Vector2d xi = (x - x0) / radius;
    const double gap = 1 - xi.squaredNorm();
    if (gap <= 0) return;
    const Vector3d L(twice_area(x, t[1], t[2]) / whole, twice_area(t[0], x, t[2]) / whole,
                     twice_area(t[0], t[1], x) / whole);
    moments += (area * gap * gap * gap) * triangle_shape_functions(L, six_nodes) *
               Vector3d(1, xi.x(), xi.y()).transpose();
  });
  if (moments.isZero(0)) return;
  for (std::size_t k = 0; k < (six_nodes ? 6 : 3); ++k)
    shares.try_emplace(nodes[k], Vector3d::Zero()).first->second +=
        moments.row(static_cast<Index>(k)).transpose();
}

}  // namespace

TriangleMesh platform_mesh(const std::array<Vector2d, 3>& vertices, const Vector2d& P,
                           int refinements, bool six_nodes) {
  constexpr int kMaxRefinements = 10;
  if (refinements < 0 || refinements > kMaxRefinements)
    throw ModelError("a platform mesh must have 0 to 10 refinements (10: three million triangles)");
  const bool clockwise = twice_area(vertices[0], vertices[1], vertices[2]) < 0;
  TriangleMesh mesh;
  mesh.nodes.assign(vertices.begin(), vertices.end());
  mesh.nodes.push_back(P);
  for (Index i = 0; i < 3; ++i) {
    const Index j = (i + 1) % 3;
    const TriangleMesh::Nodes t = clockwise ? TriangleMesh::Nodes{j, i, 3, -1, -1, -1}
                                            : TriangleMesh::Nodes{i, j, 3, -1, -1, -1};
    const auto corner = [&](std::size_t k) { return mesh.nodes[static_cast<std::size_t>(t[k])]; };
    if (!(twice_area(corner(0), corner(1), corner(2)) > 0))
      throw ModelError("the point P must lie inside the triangle C1 C2 C3 of the meshed platform");
    mesh.triangles.push_back(t);
  }
  for (int i = 0; i < refinements; ++i) mesh = split(std::move(mesh));
  if (six_nodes) add_midside_nodes(mesh);
  return mesh;
}

std::vector<std::pair<Index, double>> pin_weights(const TriangleMesh& mesh, const Vector2d& x0,
                                                  double radius) {
  Shares shares;
  for (const auto& nodes : mesh.triangles) add_node_shares_of_pin(mesh, nodes, x0, radius, shares);
  if (shares.empty()) throw ModelError("no triangle of the platform lies within the pin's radius");
  std::vector<std::pair<Index, double>> weights;
  weights.reserve(shares.size());
  for (const auto& share : shares) weights.emplace_back(share.first, 0.0);
  std::sort(weights.begin(), weights.end());

  // The coefficients (a, b) in the formula of the weights w_i (see `pin_weights`) follow from the
  // conditions sum_i w_i (1, (x_i - x0) / radius) = (1, 0, 0).
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  const auto local = [&](Index node) {
    const Vector2d xi = (mesh.nodes[static_cast<std::size_t>(node)] - x0) / radius;
    return Vector3d(1, xi.x(), xi.y());
  };
  for (const auto& entry : weights) {
    const Vector3d& share = shares.at(entry.first);
    A += local(entry.first) * share.transpose();
  }
  const Vector3d kernel = A.fullPivLu().solve(Vector3d::UnitX());
  for (auto& [node, weight] : weights) weight = shares.at(node).dot(kernel);
  return weights;
}

}  // namespace trammel::solver
