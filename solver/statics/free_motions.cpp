#include "solver/statics/free_motions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "solver/assembly/length_scales.h"
#include "solver/linalg/dense_qr.h"
#include "solver/model/labels.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Motions = std::vector<FreeMotion>;
using Kind = FreeMotion::Kind;

constexpr double kAtRest = 1e-5;  // of the largest motion: below it a part counts as at rest

/// Velocity of a rigid part at a point of it, and its angular velocity.
struct RigidMotion {
  Vector2d point = Vector2d::Zero();
  Vector2d translation = Vector2d::Zero();
  double rotation = 0;

  [[nodiscard]] Vector2d at(const Vector2d& position) const {
    return translation + rotation * perpendicular(position - point);
  }
  [[nodiscard]] Vector2d centre() const { return point + perpendicular(translation) / rotation; }
};

class FreeMotions {
 public:
  explicit FreeMotions(const System& system)
      : system_(system),
        size_(box_diagonal(system.mesh.positions)),
        weight_(length_scales(system)) {}

  [[nodiscard]] std::vector<Motions> find(const MatrixXd& basis) const {
    const MatrixXd U = weight_.asDiagonal() * (system_.T * basis);
    const std::vector<Vector3d> whole = whole_model_motions(U);
    std::vector<Motions> motions;
    for (const FreeMotion& motion : of_whole_model(whole)) motions.push_back({motion});
    for (const VectorXd& mode : localised_modes(U, static_cast<Index>(whole.size())))
      motions.push_back(of_parts(weight_.cwiseInverse().cwiseProduct(mode)));
    return motions;
  }

 private:
  [[nodiscard]] const std::array<Index, 3>& coordinates_of(Index node) const {
    return system_.coordinates.node[to_size(node)];
  }
  [[nodiscard]] Vector2d position_of(Index node) const {
    return system_.mesh.positions[to_size(node)];
  }
  [[nodiscard]] Vector2d translation_of(const VectorXd& u, Index node) const {
    return {u[coordinates_of(node)[0]], u[coordinates_of(node)[1]]};
  }

  /// Translations along x and y and rotation about the first node, rotations times the size.
  [[nodiscard]] MatrixXd rigid_body_modes() const {
    MatrixXd R = MatrixXd::Zero(weight_.size(), 3);
    for (Index u = 0; u < R.rows(); ++u) {
      const Index node = system_.coordinates.node_of[to_size(u)];
      const Vector2d arm = (position_of(node) - position_of(0)) / size_;
      if (system_.coordinates.is_rotation[to_size(u)]) {
        R(u, 2) = 1;
      } else if (coordinates_of(node)[0] == u) {
        R.row(u) << 1, 0, -arm.y();
      } else {
        R.row(u) << 0, 1, arm.x();
      }
    }
    return R;
  }

  /// Rigid motions of everything within the span of U, as factors of the rigid body modes.
  [[nodiscard]] std::vector<Vector3d> whole_model_motions(const MatrixXd& U) const {
    const ThinQr rigid = thin_qr(rigid_body_modes());
    const MatrixXd Q = thin_qr(U).Q;
    const RightSingularVectors outside =
        right_singular_vectors(rigid.Q - Q * (Q.transpose() * rigid.Q));
    std::vector<Vector3d> found;
    for (Index i = 0; i < 3; ++i) {
      if (!(outside.value[i] <= 1e-6)) continue;
      found.push_back(rigid.R.topRows<3>()
                          .triangularView<Eigen::Upper>()
                          .solve(outside.vector.col(i))
                          .normalized());
    }
    return found;
  }

  [[nodiscard]] Motions of_whole_model(std::vector<Vector3d> found) const {
    const std::string whole = "the whole model";
    if (found.size() == 3) return {{Kind::in_plane, whole, {}}};
    if (found.size() == 2) {  // one of them without rotation, the other about a centre: any on a
                              // line, of which that nearest to the first node is taken
      if (std::abs(found[0][2]) < std::abs(found[1][2])) std::swap(found[0], found[1]);
      if (std::abs(found[0][2]) < 1e-6) return {{Kind::in_translation, whole, {}}};
      found[1] -= found[0] * (found[1][2] / found[0][2]);
      const Vector2d free = found[1].head<2>().normalized();
      found[0].head<2>() -= free * free.dot(found[0].head<2>());
    }
    Motions motions;
    for (const Vector3d& motion : found)
      add({position_of(0), motion.head<2>(), motion[2] / size_}, whole, 1e-6, motions);
    return motions;
  }

  /// @param least  turn of the model's size, over the translation, that counts as a rotation
  void add(const RigidMotion& motion, const std::string& part, double least,
           Motions& motions) const {
    if (std::abs(motion.rotation) * size_ > least * motion.translation.norm())
      motions.push_back({Kind::about, part, motion.centre()});
    else
      motions.push_back({Kind::along, part, direction(motion.translation)});
  }

  [[nodiscard]] static Vector2d direction(const Vector2d& translation) {
    const Vector2d d = translation.normalized();
    return d.x() < 0 ? Vector2d(-d) : d;
  }

  /// A basis with few moving parts in each motion: reduced echelon form, the largest entries as
  /// pivots. The motions of the whole model are taken out by holding one place.
  [[nodiscard]] std::vector<VectorXd> localised_modes(MatrixXd U, Index whole_model_count) const {
    const std::vector<Index> held = held_coordinates();
    std::vector<bool> used(to_size(U.cols()), false);
    for (Index step = 0; step < U.cols(); ++step) {
      const bool holds = step < whole_model_count;
      const auto [row, col] = find_pivot(U, used, holds ? held : std::vector<Index>());
      if (U(row, col) == 0) break;
      used[to_size(col)] = true;
      U.col(col) /= U(row, col);
      for (Index c = 0; c < U.cols(); ++c) {
        if (c != col) U.col(c) -= U.col(col) * U(row, c);
      }
      if (holds) U.col(col).setZero();
    }
    std::vector<VectorXd> modes;
    for (Index c = 0; c < U.cols(); ++c) {
      const double largest = U.col(c).cwiseAbs().maxCoeff();
      if (largest > 0) modes.push_back(U.col(c) / largest);
    }
    return modes;
  }

  /// Translations of the first node and of the one farthest from it.
  [[nodiscard]] std::vector<Index> held_coordinates() const {
    const auto distance = [this](Index node) {
      return (position_of(node) - position_of(0)).norm();
    };
    Index far = 0;
    for (Index node = 0; node < std::ssize(system_.model.nodes); ++node) {
      if (distance(node) > distance(far)) far = node;
    }
    const auto &near_u = coordinates_of(0), &far_u = coordinates_of(far);
    return {near_u[0], near_u[1], far_u[0], far_u[1]};
  }

  /// The largest entry of the columns not used, the first of nearly equal ones.
  /// @param rows  where to look; everywhere if empty
  [[nodiscard]] static std::pair<Index, Index> find_pivot(const MatrixXd& U,
                                                          const std::vector<bool>& used,
                                                          const std::vector<Index>& rows) {
    std::pair<Index, Index> pivot;
    double best = -1;
    const Index count = rows.empty() ? U.rows() : std::ssize(rows);
    for (Index i = 0; i < count; ++i) {
      const Index row = rows.empty() ? i : rows[to_size(i)];
      for (Index col = 0; col < U.cols(); ++col) {
        if (used[to_size(col)] || std::abs(U(row, col)) <= best * (1 + 1e-9)) continue;
        best = std::abs(U(row, col));
        pivot = {row, col};
      }
    }
    return pivot;
  }

  /// The rigid motion of a set of nodes; empty where they are at rest, deform or are a single node.
  [[nodiscard]] std::optional<RigidMotion> fit(const VectorXd& u,
                                               const std::vector<Index>& nodes) const {
    RigidMotion motion;
    for (const Index node : nodes) motion.point += position_of(node);
    motion.point /= static_cast<double>(nodes.size());
    double inertia = 0;
    double largest = 0;
    for (const Index node : nodes) {
      const Vector2d arm = position_of(node) - motion.point;
      const Vector2d v = translation_of(u, node);
      motion.translation += v / static_cast<double>(nodes.size());
      motion.rotation += cross(arm, v);
      inertia += arm.squaredNorm();
      largest = std::max(largest, v.norm());
    }
    if (largest < kAtRest || inertia == 0) return std::nullopt;
    motion.rotation /= inertia;
    const bool deforms = std::ranges::any_of(nodes, [&](Index node) {
      return (motion.at(position_of(node)) - translation_of(u, node)).norm() > 1e-3 * largest;
    });
    if (deforms) return std::nullopt;
    return motion;
  }

  void add_fitted(const VectorXd& u, const std::vector<Index>& nodes, const std::string& part,
                  Motions& motions) const {
    if (const auto motion = fit(u, nodes)) add(*motion, part, 1e-3, motions);
  }

  [[nodiscard]] Motions of_bodies(const VectorXd& u) const {
    Motions motions;
    const Model& model = system_.model;
    const auto named = [](const char* kind, const std::string& name, std::size_t i) {
      return name.empty() ? part_label(kind, name, i) : "the " + name;
    };
    for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
      std::vector<Index> nodes = model.rigid_bodies[i].attached;
      nodes.push_back(model.rigid_bodies[i].reference);
      add_fitted(u, nodes, named("rigid body", model.rigid_bodies[i].name, i), motions);
    }
    std::vector<std::vector<Index>> plate_nodes(model.plates.size());
    for (const Triangle& triangle : model.triangles) {
      for (const Index node : triangle.nodes) {
        if (node >= 0) plate_nodes[to_size(triangle.plate)].push_back(node);
      }
    }
    for (std::size_t i = 0; i < model.plates.size(); ++i) {
      if (!plate_nodes[i].empty())
        add_fitted(u, plate_nodes[i], named("plate", model.plates[i].name, i), motions);
    }
    return motions;
  }

  [[nodiscard]] Motions of_members(const VectorXd& u) const {
    Motions motions;
    for (Index i = 0; i < std::ssize(system_.model.members); ++i) {
      const auto& nodes = system_.model.members[to_size(i)].nodes;
      add_fitted(u, {nodes[0], nodes[1]}, member_label(system_.model, i), motions);
    }
    return motions;
  }

  [[nodiscard]] Motions of_nodes(const VectorXd& u) const {
    Motions motions;
    for (Index node = 0; node < std::ssize(system_.model.nodes); ++node) {
      const std::string name = node_label(system_.model, node);
      const Vector2d v = translation_of(u, node);
      if (v.norm() > kAtRest) motions.push_back({Kind::along, name, direction(v)});
      const Index rotation = coordinates_of(node)[2];
      if (rotation >= 0 && std::abs(u[rotation]) * size_ > kAtRest)
        motions.push_back({Kind::turning, name, {}});
    }
    return motions;
  }

  /// The largest parts that move as rigid ones: bodies and plates, else members, else nodes.
  [[nodiscard]] Motions of_parts(const VectorXd& u) const {
    Motions motions = of_bodies(u);
    if (motions.empty()) motions = of_members(u);
    return motions.empty() ? of_nodes(u) : motions;
  }

  const System& system_;
  double size_;  // [m]
  VectorXd weight_;
};

}  // namespace

std::vector<std::vector<FreeMotion>> find_free_motions(const System& system,
                                                       const MatrixXd& basis) {
  if (basis.cols() == 0) return {};
  return FreeMotions(system).find(basis);
}

}  // namespace trammel::solver
