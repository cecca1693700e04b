#include "harness/scene/draw_large.h"

#include "solver/large/state_results.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

/// The model's nodes, then the members' inner points, first to second node.
std::vector<results::Point> places(const solver::large_motion::GeometricallyExactSystem& system,
                                   const Eigen::VectorXd& q) {
  const solver::Model& model = system.model();
  const Eigen::MatrixX3d motion = node_motion(system, q);
  std::vector<results::Point> nodes;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    nodes.push_back(point_of(model.nodes[i].position +
                             motion.row(static_cast<solver::Index>(i)).head<2>().transpose()));
  }
  for (std::size_t m = 0; m < model.members.size(); ++m) {
    const Eigen::MatrixX2d line = member_node_positions(system, q, static_cast<solver::Index>(m));
    for (solver::Index i = 1; i + 1 < line.rows(); ++i)
      nodes.push_back(point_of(line.row(i).transpose()));
  }
  return nodes;
}

}  // namespace

std::optional<Drawing> draw_large_model(
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
  draw_parts(model, is_manipulator, drawing);
  return drawing;
}

results::Pose draw_large_pose(const solver::large_motion::GeometricallyExactSystem& system,
                              const Eigen::VectorXd& q, const std::string& label) {
  return {label, places(system, q)};
}

}  // namespace trammel::harness
