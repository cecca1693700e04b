#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "solver/statics/zero_energy_modes.h"
#include "solver/model/labels.h"
#include "solver/model/plane.h"

namespace trammel {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStill = 1e-5;  // of the largest motion: below it a part counts as at rest
constexpr std::size_t kMostListed = 3;

/// Motion of a rigid part in the plane: velocity `shift` at `point`, turning at rate `turn`.
struct RigidMotion {
  Vector2d point = Vector2d::Zero();
  Vector2d shift = Vector2d::Zero();
  double turn = 0;
};

std::string number(double value, double size) {
  if (std::abs(value) < 1e-6 * size) value = 0;
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string along(const Vector2d& shift) {
  const Vector2d d = shift.normalized();
  if (std::abs(d.y()) < 1e-6) return "x";
  if (std::abs(d.x()) < 1e-6) return "y";
  const double sign = d.x() < 0 ? -1 : 1;
  return '(' + number(sign * d.x(), 1) + ", " + number(sign * d.y(), 1) + ')';
}

std::string join(const std::vector<std::string>& words, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < words.size() && i < most; ++i) text += (i ? "; " : "") + words[i];
  if (words.size() > most) text += "; and " + std::to_string(words.size() - most) + " more";
  return text;
}

class Narrator {
 public:
  explicit Narrator(const System& system) : system_(system) {
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
    std::vector<std::string> words;
    const Index whole = whole_model(U, words);
    for (const VectorXd& motion : localised(std::move(U), whole)) {
      words.push_back(part(weight_.cwiseInverse().cwiseProduct(motion)));
    }
    return join(words, 6);
  }

 private:
  [[nodiscard]] const std::array<Index, 3>& of(Index node) const {
    return system_.coordinates.node[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vector2d at(Index node) const {
    return system_.mesh.positions[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Vector2d shift_of(const VectorXd& u, Index node) const {
    return {u[of(node)[0]], u[of(node)[1]]};
  }

  /// Rigid motions of everything within the span of U; says them, returns how many.
  Index whole_model(const MatrixXd& U, std::vector<std::string>& words) const {
    if (U.cols() == 0) return 0;
    MatrixXd R = MatrixXd::Zero(U.rows(), 3);
    for (Index u = 0; u < U.rows(); ++u) {
      const auto i = static_cast<std::size_t>(u);
      const Index node = system_.coordinates.node_of[i];
      const Vector2d arm = (at(node) - centre_) / size_;
      if (system_.coordinates.is_rotation[i]) {
        R(u, 2) = 1;
      } else if (of(node)[0] == u) {
        R.row(u) << 1, 0, -arm.y();
      } else {
        R.row(u) << 0, 1, arm.x();
      }
    }
    const Eigen::HouseholderQR<MatrixXd> qr(R);
    const MatrixXd QR = qr.householderQ() * MatrixXd::Identity(U.rows(), 3);
    const Eigen::HouseholderQR<MatrixXd> qu(U);
    const MatrixXd QU = qu.householderQ() * MatrixXd::Identity(U.rows(), U.cols());
    const MatrixXd overlap = QU.transpose() * QR;
    const Eigen::JacobiSVD<MatrixXd> outside(QR - QU * overlap, Eigen::ComputeThinV);
    std::vector<Vector3d> found;
    for (Index i = 0; i < 3; ++i) {
      if (outside.singularValues()[i] > 1e-6) continue;
      const Vector3d in_R =
          qr.matrixQR().topRows<3>().triangularView<Eigen::Upper>().solve(outside.matrixV().col(i));
      found.push_back(in_R.normalized());
    }
    say_whole(found, words);
    return static_cast<Index>(found.size());
  }

  void say_whole(std::vector<Vector3d> found, std::vector<std::string>& words) const {
    const std::string model = "the whole model ";
    if (found.size() == 3) {
      words.push_back(model + "moves freely in the plane (along x, along y and in rotation)");
      return;
    }
    if (found.size() == 2) {  // one of them without rotation, the other about a centre
      if (std::abs(found[0][2]) < std::abs(found[1][2])) std::swap(found[0], found[1]);
      if (std::abs(found[0][2]) < 1e-6) {
        words.push_back(model + "moves freely along x and along y");
        return;
      }
      found[1] -= found[0] * (found[1][2] / found[0][2]);
    }
    for (const Vector3d& motion : found) {
      RigidMotion rigid{centre_, motion.head<2>(), motion[2] / size_};
      words.push_back(rigid.turn * size_ > 1e-6 || rigid.turn * size_ < -1e-6
                          ? "rotation of " + model + "about " + centre_of(rigid)
                          : model + "moves freely along " + along(rigid.shift));
    }
  }

  [[nodiscard]] std::string centre_of(const RigidMotion& m) const {
    const Vector2d c = m.point + Vector2d(-m.shift.y(), m.shift.x()) / m.turn;
    return '(' + number(c.x(), size_) + ", " + number(c.y(), size_) + ") m";
  }

  /// A basis with few moving parts in each motion: reduced echelon form, the largest entries as
  /// pivots. The motions of the whole model, already said, are taken out by holding one place.
  [[nodiscard]] std::vector<VectorXd> localised(MatrixXd U, Index whole) const {
    std::vector<VectorXd> motions;
    const Index last = static_cast<Index>(system_.model.nodes.size()) - 1;
    std::vector<Index> held = {of(0)[0], of(0)[1]};
    Index far = last;
    for (Index node = 0; node <= last; ++node) {
      if ((at(node) - at(0)).norm() > (at(far) - at(0)).norm()) far = node;
    }
    held.insert(held.end(), {of(far)[0], of(far)[1]});
    std::vector<bool> used(static_cast<std::size_t>(U.cols()), false);
    for (Index step = 0; step < U.cols(); ++step) {
      Index row = 0;
      Index col = 0;
      double best = -1;
      const auto look = [&](Index r) {
        for (Index c = 0; c < U.cols(); ++c) {
          if (used[static_cast<std::size_t>(c)] || std::abs(U(r, c)) <= best * (1 + 1e-9)) continue;
          best = std::abs(U(r, c));
          row = r;
          col = c;
        }
      };
      if (step < whole) {
        for (const Index r : held) look(r);
      } else {
        for (Index r = 0; r < U.rows(); ++r) look(r);
      }
      if (best <= 0) break;
      used[static_cast<std::size_t>(col)] = true;
      U.col(col) /= U(row, col);
      for (Index c = 0; c < U.cols(); ++c) {
        if (c != col) U.col(c) -= U.col(col) * U(row, c);
      }
      if (step < whole) U.col(col).setZero();
    }
    for (Index c = 0; c < U.cols(); ++c) {
      const double largest = U.col(c).cwiseAbs().maxCoeff();
      if (largest > 0) motions.push_back(U.col(c) / largest);
    }
    return motions;
  }

  /// The rigid motion of a set of nodes; empty where they are at rest, deform or are a single node.
  [[nodiscard]] std::optional<RigidMotion> fit(const VectorXd& u,
                                               const std::vector<Index>& nodes) const {
    RigidMotion motion;
    for (const Index node : nodes) motion.point += at(node);
    motion.point /= static_cast<double>(nodes.size());
    double inertia = 0;
    double largest = 0;
    for (const Index node : nodes) {
      const Vector2d arm = at(node) - motion.point;
      const Vector2d v = shift_of(u, node);
      motion.shift += v / static_cast<double>(nodes.size());
      motion.turn += cross(arm, v);
      inertia += arm.squaredNorm();
      largest = std::max(largest, v.norm());
    }
    if (largest < kStill || inertia == 0) return std::nullopt;
    motion.turn /= inertia;
    for (const Index node : nodes) {
      const Vector2d arm = at(node) - motion.point;
      const Vector2d v = motion.shift + motion.turn * Vector2d(-arm.y(), arm.x());
      if ((v - shift_of(u, node)).norm() > 1e-3 * largest) return std::nullopt;
    }
    return motion;
  }

  void say(const std::optional<RigidMotion>& motion, const std::string& name,
           std::vector<std::string>& words) const {
    if (!motion) return;
    if (std::abs(motion->turn) * size_ > 1e-3 * motion->shift.norm()) {
      words.push_back("rotation of " + name + " about " + centre_of(*motion));
    } else {
      words.push_back(name + " moves freely along " + along(motion->shift));
    }
  }

  [[nodiscard]] std::vector<std::string> bodies(const VectorXd& u) const {
    std::vector<std::string> words;
    const Model& model = system_.model;
    const auto named = [](const char* kind, const std::string& name, std::size_t i) {
      return name.empty() ? part_label(kind, name, i) : "the " + name;
    };
    for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
      std::vector<Index> nodes = model.rigid_bodies[i].attached;
      nodes.push_back(model.rigid_bodies[i].reference);
      say(fit(u, nodes), named("rigid body", model.rigid_bodies[i].name, i), words);
    }
    std::vector<std::vector<Index>> plate_nodes(model.plates.size());
    for (const Triangle& triangle : model.triangles) {
      for (const Index node : triangle.nodes) {
        if (node >= 0) plate_nodes[static_cast<std::size_t>(triangle.plate)].push_back(node);
      }
    }
    for (std::size_t i = 0; i < model.plates.size(); ++i) {
      if (plate_nodes[i].empty()) continue;
      say(fit(u, plate_nodes[i]), named("plate", model.plates[i].name, i), words);
    }
    return words;
  }

  [[nodiscard]] std::vector<std::string> members(const VectorXd& u) const {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < system_.model.members.size(); ++i) {
      const auto& nodes = system_.model.members[i].nodes;
      say(fit(u, {nodes[0], nodes[1]}), member_label(system_.model, static_cast<Index>(i)), words);
    }
    return words;
  }

  [[nodiscard]] std::vector<std::string> lone_coordinates(const VectorXd& u) const {
    std::vector<std::string> words;
    const auto node_count = static_cast<Index>(system_.model.nodes.size());
    for (Index node = 0; node < node_count; ++node) {
      const std::string name = node_label(system_.model, node);
      const Vector2d v = shift_of(u, node);
      if (v.norm() > kStill) words.push_back(name + " moves freely along " + along(v));
      const Index rotation = of(node)[2];
      if (rotation >= 0 && std::abs(u[rotation]) * size_ > kStill) {
        words.push_back(name + " turns freely");
      }
    }
    return words;
  }

  [[nodiscard]] std::string part(const VectorXd& u) const {
    std::vector<std::string> words = bodies(u);
    if (words.empty()) words = members(u);
    if (words.empty()) words = lone_coordinates(u);
    return words.size() == 1 ? words.front() : join(words, kMostListed);
  }

  const System& system_;
  Vector2d centre_;
  double size_ = 1;
  VectorXd weight_;
};

}  // namespace

std::string describe_free_motions(const System& system, const FreeMotions& motions) {
  if (motions.count() == 0) return "";
  std::string words = Narrator(system).describe(motions.basis);
  if (!motions.all_found) words += "; and others";
  return words;
}

}  // namespace trammel
