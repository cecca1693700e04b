#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "solver/linalg/dense_qr.h"
#include "solver/model/labels.h"
#include "solver/model/plane.h"
#include "solver/statics/zero_energy_modes.h"

namespace trammel::solver {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kAtRest = 1e-5;  // of the largest motion: below it a part counts as at rest
constexpr std::size_t kMaxListed = 3;

/// Motion of a rigid part in the plane: velocity `shift` at `point`, turning at rate `turn`.
struct RigidMotion {
  Vector2d point = Vector2d::Zero();
  Vector2d translation = Vector2d::Zero();
  double rotation = 0;
};

std::string number(double value, double size) {
  if (std::abs(value) < 1e-6 * size) value = 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string along(const Vector2d& translation) {
  const Vector2d d = translation.normalized();
  if (std::abs(d.y()) < 1e-6) return "x";
  if (std::abs(d.x()) < 1e-6) return "y";
  const double sign = d.x() < 0 ? -1 : 1;
  return '(' + number(sign * d.x(), 1) + ", " + number(sign * d.y(), 1) + ')';
}

std::string join(const std::vector<std::string>& phrases, std::size_t max_count) {
  std::string text;
  for (std::size_t i = 0; i < phrases.size() && i < max_count; ++i)
    text += (i ? "; " : "") + phrases[i];
  if (phrases.size() > max_count)
    text += "; and " + std::to_string(phrases.size() - max_count) + " more";
  return text;
}

class MechanismDescription {
 public:
  explicit MechanismDescription(const System& system) : system_(system) {
    Vector2d low = system.mesh.positions.front();
    Vector2d high = low;
    for (const Vector2d& p : system.mesh.positions) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    centre_ = (low + high) / 2;
    size_ = (high - low).norm() > 0 ? (high - low).norm() : 1.0;
    weight_ = VectorXd::Ones(system.coordinates.size);
    for (Index u = 0; u < weight_.size(); ++u) {
      if (system.coordinates.is_rotation[static_cast<std::size_t>(u)]) weight_[u] = size_;
    }
  }

  std::string describe(const MatrixXd& basis) {
    MatrixXd U = weight_.asDiagonal() * (system_.T * basis);
    std::vector<std::string> phrases;
    const Index whole_model_count = find_whole_model_motions(U, phrases);
    for (const VectorXd& motion : localised_modes(std::move(U), whole_model_count)) {
      phrases.push_back(describe_part(weight_.cwiseInverse().cwiseProduct(motion)));
    }
    return join(phrases, 6);
  }

 private:
  [[nodiscard]] const std::array<Index, 3>& coordinates_of(Index node) const {
    return system_.coordinates.node[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vector2d position_of(Index node) const {
    return system_.mesh.positions[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vector2d translation_of(const VectorXd& u, Index node) const {
    return {u[coordinates_of(node)[0]], u[coordinates_of(node)[1]]};
  }

  /// Rigid motions of everything within the span of U; says them, returns how many.
  Index find_whole_model_motions(const MatrixXd& U, std::vector<std::string>& phrases) const {
    if (U.cols() == 0) return 0;
    MatrixXd R = MatrixXd::Zero(U.rows(), 3);
    for (Index u = 0; u < U.rows(); ++u) {
      const auto i = static_cast<std::size_t>(u);
      const Index node = system_.coordinates.node_of[i];
      const Vector2d arm = (position_of(node) - centre_) / size_;
      if (system_.coordinates.is_rotation[i]) {
        R(u, 2) = 1;
      } else if (coordinates_of(node)[0] == u) {
        R.row(u) << 1, 0, -arm.y();
      } else {
        R.row(u) << 0, 1, arm.x();
      }
    }
    const ThinQr rigid = thin_qr(R);
    const MatrixXd QU = thin_qr(U).Q;
    const MatrixXd overlap = QU.transpose() * rigid.Q;
    const RightSingularVectors outside = right_singular_vectors(rigid.Q - QU * overlap);
    std::vector<Vector3d> found;
    for (Index i = 0; i < 3; ++i) {
      if (!(outside.value[i] <= 1e-6)) continue;
      const Vector3d in_R =
          rigid.R.topRows<3>().triangularView<Eigen::Upper>().solve(outside.vector.col(i));
      found.push_back(in_R.normalized());
    }
    describe_whole_model(found, phrases);
    return static_cast<Index>(found.size());
  }

  void describe_whole_model(std::vector<Vector3d> found, std::vector<std::string>& phrases) const {
    const std::string model = "the whole model ";
    if (found.size() == 3) {
      phrases.push_back(model + "moves freely in the plane (along x, along y and in rotation)");
      return;
    }
    if (found.size() == 2) {  // one of them without rotation, the other about a centre
      if (std::abs(found[0][2]) < std::abs(found[1][2])) std::swap(found[0], found[1]);
      if (std::abs(found[0][2]) < 1e-6) {
        phrases.push_back(model + "moves freely along x and along y");
        return;
      }
      found[1] -= found[0] * (found[1][2] / found[0][2]);
    }
    for (const Vector3d& motion : found) {
      RigidMotion rigid{centre_, motion.head<2>(), motion[2] / size_};
      phrases.push_back(rigid.rotation * size_ > 1e-6 || rigid.rotation * size_ < -1e-6
                            ? "rotation of " + model + "about " + centre_of(rigid)
                            : model + "moves freely along " + along(rigid.translation));
    }
  }

  [[nodiscard]] std::string centre_of(const RigidMotion& m) const {
    const Vector2d c = m.point + Vector2d(-m.translation.y(), m.translation.x()) / m.rotation;
    return '(' + number(c.x(), size_) + ", " + number(c.y(), size_) + ") m";
  }

  /// A basis with few moving parts in each motion: reduced echelon form, the largest entries as
  /// pivots. The motions of the whole model, already said, are taken out by holding one place.
  [[nodiscard]] std::vector<VectorXd> localised_modes(MatrixXd U, Index whole_model_count) const {
    std::vector<VectorXd> modes;
    const Index last = static_cast<Index>(system_.model.nodes.size()) - 1;
    std::vector<Index> held = {coordinates_of(0)[0], coordinates_of(0)[1]};
    Index far = last;
    for (Index node = 0; node <= last; ++node) {
      if ((position_of(node) - position_of(0)).norm() > (position_of(far) - position_of(0)).norm())
        far = node;
    }
    held.insert(held.end(), {coordinates_of(far)[0], coordinates_of(far)[1]});
    std::vector<bool> used(static_cast<std::size_t>(U.cols()), false);
    for (Index step = 0; step < U.cols(); ++step) {
      Index row = 0;
      Index col = 0;
      double best = -1;
      const auto search_row = [&](Index r) {
        for (Index c = 0; c < U.cols(); ++c) {
          if (used[static_cast<std::size_t>(c)] || std::abs(U(r, c)) <= best * (1 + 1e-9)) continue;
          best = std::abs(U(r, c));
          row = r;
          col = c;
        }
      };
      if (step < whole_model_count) {
        for (const Index r : held) search_row(r);
      } else {
        for (Index r = 0; r < U.rows(); ++r) search_row(r);
      }
      if (best <= 0) break;
      used[static_cast<std::size_t>(col)] = true;
      U.col(col) /= U(row, col);
      for (Index c = 0; c < U.cols(); ++c) {
        if (c != col) U.col(c) -= U.col(col) * U(row, c);
      }
      if (step < whole_model_count) U.col(col).setZero();
    }
    for (Index c = 0; c < U.cols(); ++c) {
      const double largest = U.col(c).cwiseAbs().maxCoeff();
      if (largest > 0) modes.push_back(U.col(c) / largest);
    }
    return modes;
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
    for (const Index node : nodes) {
      const Vector2d arm = position_of(node) - motion.point;
      const Vector2d v = motion.translation + motion.rotation * Vector2d(-arm.y(), arm.x());
      if ((v - translation_of(u, node)).norm() > 1e-3 * largest) return std::nullopt;
    }
    return motion;
  }

  void describe_rigid_motion(const std::optional<RigidMotion>& motion, const std::string& name,
                             std::vector<std::string>& phrases) const {
    if (!motion) return;
    if (std::abs(motion->rotation) * size_ > 1e-3 * motion->translation.norm()) {
      phrases.push_back("rotation of " + name + " about " + centre_of(*motion));
    } else {
      phrases.push_back(name + " moves freely along " + along(motion->translation));
    }
  }

  [[nodiscard]] std::vector<std::string> bodies(const VectorXd& u) const {
    std::vector<std::string> phrases;
    const Model& model = system_.model;
    const auto named = [](const char* kind, const std::string& name, std::size_t i) {
      return name.empty() ? part_label(kind, name, i) : "the " + name;
    };
    for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
      std::vector<Index> nodes = model.rigid_bodies[i].attached;
      nodes.push_back(model.rigid_bodies[i].reference);
      describe_rigid_motion(fit(u, nodes), named("rigid body", model.rigid_bodies[i].name, i),
                            phrases);
    }
    std::vector<std::vector<Index>> plate_nodes(model.plates.size());
    for (const Triangle& triangle : model.triangles) {
      for (const Index node : triangle.nodes) {
        if (node >= 0) plate_nodes[static_cast<std::size_t>(triangle.plate)].push_back(node);
      }
    }
    for (std::size_t i = 0; i < model.plates.size(); ++i) {
      if (plate_nodes[i].empty()) continue;
      describe_rigid_motion(fit(u, plate_nodes[i]), named("plate", model.plates[i].name, i),
                            phrases);
    }
    return phrases;
  }

  [[nodiscard]] std::vector<std::string> members(const VectorXd& u) const {
    std::vector<std::string> phrases;
    for (std::size_t i = 0; i < system_.model.members.size(); ++i) {
      const auto& nodes = system_.model.members[i].nodes;
      describe_rigid_motion(fit(u, {nodes[0], nodes[1]}),
                            member_label(system_.model, static_cast<Index>(i)), phrases);
    }
    return phrases;
  }

  [[nodiscard]] std::vector<std::string> single_nodes(const VectorXd& u) const {
    std::vector<std::string> phrases;
    const auto node_count = static_cast<Index>(system_.model.nodes.size());
    for (Index node = 0; node < node_count; ++node) {
      const std::string name = node_label(system_.model, node);
      const Vector2d v = translation_of(u, node);
      if (v.norm() > kAtRest) phrases.push_back(name + " moves freely along " + along(v));
      const Index rotation = coordinates_of(node)[2];
      if (rotation >= 0 && std::abs(u[rotation]) * size_ > kAtRest) {
        phrases.push_back(name + " turns freely");
      }
    }
    return phrases;
  }

  [[nodiscard]] std::string describe_part(const VectorXd& u) const {
    std::vector<std::string> phrases = bodies(u);
    if (phrases.empty()) phrases = members(u);
    if (phrases.empty()) phrases = single_nodes(u);
    return phrases.size() == 1 ? phrases.front() : join(phrases, kMaxListed);
  }

  const System& system_;
  Vector2d centre_;
  double size_ = 1;
  VectorXd weight_;
};

}  // namespace

std::string describe_mechanism(const System& system, const ZeroEnergyModes& modes) {
  if (modes.count() == 0) return "";
  std::string text = MechanismDescription(system).describe(modes.basis);
  if (!modes.all_found) text += "; and others";
  return text;
}

}  // namespace trammel::solver
