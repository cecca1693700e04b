#include "harness/scene/drawing.h"

#include <algorithm>

#include "harness/base/find_or_add.h"
#include "harness/base/text.h"
#include "solver/large/state_results.h"

namespace trammel::harness {
namespace {

constexpr std::size_t kMaxNodesWithMidpoints = 1500;
constexpr std::size_t kPointsPerMember = 12;
constexpr std::size_t kMaxMovedNodes = 6000;  ///< maximum number of nodes over all drawn times
/// Minimum ratio of two path lengths in the space of coordinates: polygon through the drawn samples
/// to polygon through all samples.
constexpr double kShownShare = 0.8;

/// Returns the number of straight pieces by which an element is drawn.
std::size_t pieces(const solver::System& system, const solver::FrameElement& element) {
  const auto elements =
      solver::to_size(system.model.members[solver::to_size(element.member)].elements);
  if (element.is_bar()) return 1;
  return std::max<std::size_t>(1, (kPointsPerMember + elements - 1) / elements);
}

/// Drawn nodes of the mesh in drawing order, and their inverse map (-1: not drawn).
struct DrawnNodes {
  std::vector<std::size_t> mesh;
  std::vector<solver::Index> number;

  [[nodiscard]] int index_of(solver::Index node) const {
    return static_cast<int>(number[solver::to_size(node)]);
  }
};

DrawnNodes drawn_nodes(const solver::System& system) {
  DrawnNodes drawn;
  drawn.number.assign(system.mesh.positions.size(), 0);
  if (drawn.number.size() > kMaxNodesWithMidpoints)
    for (const solver::Triangle& triangle : system.model.triangles)
      for (std::size_t k = 3; triangle.quadratic() && k < 6; ++k) {
        const solver::Index middle = triangle.nodes[k];
        if (system.model.nodes[solver::to_size(middle)].name.empty())
          drawn.number[solver::to_size(middle)] = -1;
      }
  for (std::size_t i = 0; i < drawn.number.size(); ++i) {
    if (drawn.number[i] < 0) continue;
    drawn.number[i] = static_cast<solver::Index>(drawn.mesh.size());
    drawn.mesh.push_back(i);
  }
  return drawn;
}

void draw_members(const solver::System& system, const DrawnNodes& drawn, Drawing& drawing) {
  for (const solver::FrameElement& element : system.mesh.frame) {
    const std::size_t count = pieces(system, element);
    const Eigen::Vector2d start = system.mesh.positions[solver::to_size(element.nodes[0])];
    const Eigen::Vector2d span = system.mesh.positions[solver::to_size(element.nodes[1])] - start;
    int before = drawn.index_of(element.nodes[0]);
    for (std::size_t k = 1; k < count; ++k) {
      drawing.nodes.push_back(
          point_at_position(start + span * static_cast<double>(k) / static_cast<double>(count)));
      const auto last = static_cast<int>(drawing.nodes.size() - 1);
      drawing.members.push_back({before, last});
      before = last;
    }
    drawing.members.push_back({before, drawn.index_of(element.nodes[1])});
  }
}

void draw_triangles(const solver::Model& model, const DrawnNodes& drawn, Drawing& drawing) {
  for (const solver::Triangle& triangle : model.triangles) {
    std::vector<int>& around = drawing.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      around.push_back(drawn.index_of(triangle.nodes[k]));
      const solver::Index middle = triangle.nodes[3 + k];
      if (middle >= 0 && drawn.number[solver::to_size(middle)] >= 0)
        around.push_back(drawn.index_of(middle));
    }
  }
}

/// Draws a rigid body as a bar to its only node, or as a fan of triangles about its reference
/// node.
void draw_rigid_bodies(const solver::Model& model, const DrawnNodes& drawn, Drawing& drawing) {
  for (const solver::RigidBody& body : model.rigid_bodies) {
    const int reference = drawn.index_of(body.reference);
    const std::size_t count = body.attached.size();
    if (count == 1) drawing.members.push_back({reference, drawn.index_of(body.attached.front())});
    for (std::size_t k = 0; k + 1 < count || (k + 1 == count && count > 2); ++k)
      drawing.triangles.push_back({reference, drawn.index_of(body.attached[k]),
                                   drawn.index_of(body.attached[(k + 1) % count])});
  }
}

/// Draws one joint symbol per node. If a node has several joints, only the most specific
/// type is drawn.
void draw_joints(const solver::Model& model, bool is_manipulator, const DrawnNodes& drawn,
                 Drawing& drawing) {
  std::vector<std::string> kind(model.nodes.size());
  for (const solver::Member& member : model.members)
    for (std::size_t end = 0; end < 2; ++end) {
      std::string& word = kind[solver::to_size(member.nodes[end])];
      if (member.ends[end].fixity == solver::EndFixity::hinged) word = "hinged";
      if (member.ends[end].fixity == solver::EndFixity::sprung) word = "sprung";
    }
  for (const solver::RigidBody& body : model.rigid_bodies) {
    std::string& word = kind[solver::to_size(body.reference)];
    if (word.empty()) word = "rigid";
  }
  for (const solver::Support& support : model.supports) {
    const bool named =
        !support.name.empty() && !model.nodes[solver::to_size(support.node)].name.empty();
    if (named) kind[solver::to_size(support.node)] = "support";
  }
  if (is_manipulator)
    for (std::size_t i = 0; i < 3; ++i) {
      kind[i] = "active";
      for (const std::size_t node : {3 + i, 6 + i})
        if (kind[node].empty()) kind[node] = "welded";
    }
  for (std::size_t i = 0; i < kind.size(); ++i) {
    if (kind[i].empty()) continue;
    drawing.joints.push_back(
        {drawn.index_of(static_cast<solver::Index>(i)), kind[i], model.nodes[i].name});
  }
}

void draw_model_parts(const solver::Model& model, bool is_manipulator, const DrawnNodes& drawn,
                      Drawing& drawing) {
  draw_triangles(model, drawn, drawing);
  draw_rigid_bodies(model, drawn, drawing);
  draw_joints(model, is_manipulator, drawn, drawing);
}

}  // namespace

void draw_model_parts(const solver::Model& model, bool is_manipulator, Drawing& drawing) {
  DrawnNodes all;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    all.mesh.push_back(i);
    all.number.push_back(static_cast<solver::Index>(i));
  }
  draw_model_parts(model, is_manipulator, all, drawing);
}

Eigen::Vector2d displacement_at_fraction(const solver::FrameElement& element,
                                         const Eigen::VectorXd& u, double s) {
  const auto value = [&](std::size_t k) {
    return element.coordinates[k] < 0 ? 0 : u[element.coordinates[k]];
  };
  const Eigen::Vector2d t = element.direction;
  const Eigen::Vector2d n(-t.y(), t.x());
  const Eigen::Vector2d first(value(0), value(1));
  const Eigen::Vector2d second(value(3), value(4));
  const double along = (1 - s) * first.dot(t) + s * second.dot(t), l = element.length;
  const double across =
      (1 - 3 * s * s + 2 * s * s * s) * first.dot(n) + (s - 2 * s * s + s * s * s) * l * value(2) +
      (3 * s * s - 2 * s * s * s) * second.dot(n) + (s * s * s - s * s) * l * value(5);
  return along * t + across * n;
}

/// Draws the sum of the forces on each node, and uniform loads of members at the element ends.
void draw_forces(const solver::System& system, const DrawnNodes& drawn, Drawing& drawing) {
  for (const solver::NodalLoad& load : system.model.loads)
    if (const int node = drawn.index_of(load.node); node >= 0) {
      const auto same = [node](const results::DrawnForce& other) { return other.node == node; };
      auto& sum = find_or_add(drawing.forces, same, {node, 0, 0, "N"});
      sum.x += load.force[0], sum.y += load.force[1];
    }
  for (const solver::FrameElement& element : system.mesh.frame) {
    const Eigen::Vector2d& load = system.model.members[solver::to_size(element.member)].load;
    for (std::size_t i = 0; i < 2 && !load.isZero(0); ++i)
      drawing.forces.push_back({drawn.index_of(element.nodes[i]), load.x(), load.y(), "N/m"});
  }
}

std::optional<Drawing> draw_model(const solver::System& system, bool is_manipulator) {
  Drawing drawing;
  const DrawnNodes drawn = drawn_nodes(system);
  if (drawn.mesh.size() > kMaxDrawnNodes) return std::nullopt;
  for (const std::size_t node : drawn.mesh)
    drawing.nodes.push_back(point_at_position(system.mesh.positions[node]));
  draw_members(system, drawn, drawing);
  draw_model_parts(system.model, is_manipulator, drawn, drawing);
  draw_forces(system, drawn, drawing);
  if (drawing.nodes.size() > kMaxDrawnNodes) return std::nullopt;
  return drawing;
}

results::Shape draw_shape(const solver::System& system, const Eigen::VectorXd& q,
                          const std::string& label) {
  const Eigen::VectorXd u = system.T * q;
  results::Shape shape{label, {}};
  for (const std::size_t node : drawn_nodes(system).mesh) {
    const auto& coordinates = system.coordinates.node[node];
    shape.displacement.emplace_back(u[coordinates[0]], u[coordinates[1]]);
  }
  for (const solver::FrameElement& element : system.mesh.frame) {
    const std::size_t count = pieces(system, element);
    for (std::size_t k = 1; k < count; ++k)
      shape.displacement.push_back(point_at_position(displacement_at_fraction(
          element, u, static_cast<double>(k) / static_cast<double>(count))));
  }
  return shape;
}

std::size_t max_drawn_times(std::size_t nodes) {
  return std::clamp<std::size_t>(kMaxMovedNodes / std::max<std::size_t>(nodes, 1), 6, 48);
}

std::string time_label(double time) {
  return rounded(time, 4) + " s";
}

std::vector<std::size_t> samples_to_draw(const std::vector<Eigen::VectorXd>& q, std::size_t nodes) {
  const std::size_t most = max_drawn_times(nodes);
  std::vector<std::size_t> samples;
  for (std::size_t count = q.size(); count > 1; count = (count + 1) / 2) {
    const std::size_t moments = std::min(count, most);
    samples.clear();
    for (std::size_t k = 0; k < moments; ++k) samples.push_back(k * (count - 1) / (moments - 1));
    double all = 0, shown = 0;
    for (std::size_t i = 1; i < count; ++i) all += (q[i] - q[i - 1]).norm();
    for (std::size_t k = 1; k < moments; ++k) shown += (q[samples[k]] - q[samples[k - 1]]).norm();
    if (!(shown < kShownShare * all)) break;
  }
  return samples;
}

Drawing draw_manipulator(const solver::ManipulatorGeometry& geometry,
                         const std::vector<solver::TrajectoryPoint>& motion) {
  const auto nodes_at = [&](const solver::Pose& pose) {
    const solver::Posture posture = solver::inverse_kinematics(geometry, pose);
    std::vector<results::Point> nodes;
    for (const auto& joints : {geometry.base, posture.B, posture.C})
      for (const Eigen::Vector2d& joint : joints) nodes.push_back(point_at_position(joint));
    nodes.emplace_back(pose.x, pose.y);
    return nodes;
  };
  Drawing drawing;
  drawing.nodes = nodes_at(motion.front().pose);
  for (int i = 0; i < 3; ++i) {
    drawing.members.push_back({i, 3 + i});
    drawing.members.push_back({3 + i, 6 + i});
    drawing.triangles.push_back({6 + i, 6 + (i + 1) % 3, 9});
    const std::string limb = std::to_string(i + 1);
    drawing.joints.push_back({i, "active", "A" + limb});
    drawing.joints.push_back({3 + i, "hinged", "B" + limb});
    drawing.joints.push_back({6 + i, "hinged", "C" + limb});
  }
  if (motion.size() < 2) return drawing;
  const std::size_t moments = std::min(motion.size(), max_drawn_times(drawing.nodes.size()));
  for (std::size_t k = 0; k < moments; ++k) {
    const solver::TrajectoryPoint& point = motion[k * (motion.size() - 1) / (moments - 1)];
    drawing.poses.push_back({time_label(point.time), nodes_at(point.pose), point.time});
  }
  return drawing;
}

namespace {

/// Returns the model's nodes, followed by the inner points of each member from its first to its
/// second node.
std::vector<results::Point> places(const solver::large_motion::GeometricallyExactSystem& system,
                                   const Eigen::VectorXd& q) {
  const solver::Model& model = system.model();
  const Eigen::MatrixX3d motion = node_motion(system, q);
  std::vector<results::Point> nodes;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    nodes.push_back(point_at_position(
        model.nodes[i].position + motion.row(static_cast<solver::Index>(i)).head<2>().transpose()));
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Eigen::MatrixX2d line = member_node_positions(system, q, static_cast<solver::Index>(m));
    for (solver::Index i = 1; i + 1 < line.rows(); ++i)
      nodes.push_back(point_at_position(line.row(i).transpose()));
  }
  return nodes;
}

}  // namespace

std::optional<Drawing> draw_initial_pose(
    const solver::large_motion::GeometricallyExactSystem& system, bool is_manipulator) {
  const solver::Model& model = system.model();
  const Eigen::VectorXd reference = system.reference_state().q;
  Drawing drawing;
  drawing.nodes = places(system, reference);
  if (drawing.nodes.size() > kMaxDrawnNodes) return std::nullopt;
  auto inner = static_cast<int>(model.nodes.size());
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const solver::Index points =
        member_node_positions(system, reference, static_cast<solver::Index>(m)).rows();
    auto before = static_cast<int>(model.members[m].nodes[0]);
    for (solver::Index i = 1; i + 1 < points; ++i, ++inner) {
      drawing.members.push_back({before, inner});
      before = inner;
    }
    drawing.members.push_back({before, static_cast<int>(model.members[m].nodes[1])});
  }
  draw_model_parts(model, is_manipulator, drawing);
  return drawing;
}

results::Pose draw_pose(const solver::large_motion::GeometricallyExactSystem& system,
                        const Eigen::VectorXd& q, const std::string& label) {
  return {label, places(system, q)};
}

}  // namespace trammel::harness
