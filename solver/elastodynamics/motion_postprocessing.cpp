#include "solver/elastodynamics/motion_postprocessing.h"

#include <algorithm>
#include <cmath>

#include "solver/elements/triangle_element.h"
#include "solver/model/plane.h"
#include "solver/statics/postprocessing.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

class MotionPostprocessor {
 public:
  MotionPostprocessor(const MovingSystem& moving, const VectorXd& q,
                      const MovingSystem::Forces& forces, WholeBalance& balance)
      : moving_(moving),
        system_(moving.start()),
        model_(system_.model),
        u_(moving.constraints().T * q),
        forces_(forces),
        balance_(balance),
        multipliers_(moving.constraints().multipliers(forces.total)) {
    state_.q = q;
  }

  StaticSolution run() {
    members();
    triangles();
    equilibrium();
    return std::move(state_);
  }

 private:
  /// Section forces, with the tension of inextensible members, which is a constraint's.
  void members() {
    const auto& constraints = moving_.constraints();
    Eigen::Matrix<double, 6, Eigen::Dynamic> ends = forces_.element;
    for (std::size_t r = 0; r < constraints.rows.size(); ++r) {
      if (constraints.rows[r].source != ConstraintRow::Source::inextensible) continue;
      const double tension = -multipliers_[static_cast<Index>(r)];
      ends(0, constraints.rows[r].index) -= tension;
      ends(3, constraints.rows[r].index) += tension;
    }
    std::vector<Vector2d> positions;
    for (Index node = 0; node < std::ssize(model_.nodes); ++node)
      positions.push_back(moving_.position(node));
    recover(system_, {positions, u_, constraints, multipliers_, std::move(ends)}, state_);
  }

  void triangles() {
    state_.triangle_stress.resize(static_cast<Index>(model_.triangles.size()), 3);
    for (std::size_t i = 0; i < model_.triangles.size(); ++i) {
      const Triangle& triangle = model_.triangles[i];
      TrianglePoints points;
      Vector6d local;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto node = static_cast<std::size_t>(triangle.nodes[k]);
        points[k] = moving_.position(triangle.nodes[k]);
        local[static_cast<Index>(2 * k)] = u_[system_.coordinates.node[node][0]];
        local[static_cast<Index>(2 * k + 1)] = u_[system_.coordinates.node[node][1]];
      }
      const Material& material = model_.plates[static_cast<std::size_t>(triangle.plate)].material;
      state_.triangle_stress.row(static_cast<Index>(i)) =
          membrane_stress(material, triangle_deformation(points) * local);
    }
  }

  /// Reactions, loads, weight, inertia and the drag of damping by mass add up to nothing.
  void equilibrium() {
    Vector2d force = Vector2d::Zero();
    double moment = 0;
    Vector2d terms = Vector2d::Zero();
    const auto add = [&](const Vector2d& at, const Vector2d& f, double m) {
      force += f;
      moment += m + cross(at, f);
      terms[0] += f.norm();
      terms[1] += std::abs(m) + at.norm() * f.norm();
    };
    const auto nodes = static_cast<Index>(system_.coordinates.node.size());
    for (Index node = 0; node < nodes; ++node) {
      const auto& c = system_.coordinates.node[static_cast<std::size_t>(node)];
      add(moving_.position(node), {forces_.external[c[0]], forces_.external[c[1]]},
          c[2] < 0 ? 0 : forces_.external[c[2]]);
    }
    for (std::size_t i = 0; i < model_.members.size(); ++i) {
      for (std::size_t end = 0; end < 2; ++end) {
        const Index own = system_.coordinates.member_end[i][end];
        const auto node = static_cast<std::size_t>(model_.members[i].nodes[end]);
        if (own >= 0 && own != system_.coordinates.node[node][2]) moment += forces_.external[own];
      }
    }
    for (std::size_t i = 0; i < model_.supports.size(); ++i) {
      const Eigen::RowVector3d r = state_.reaction.row(static_cast<Index>(i));
      add(moving_.position(model_.supports[i].node), {r[0], r[1]}, r[2]);
    }
    state_.equilibrium_residual = force.norm();
    state_.moment_residual = std::abs(moment);
    balance_.residual = balance_.residual.cwiseMax(Vector2d(force.norm(), std::abs(moment)));
    balance_.terms = balance_.terms.cwiseMax(terms);
  }

  const MovingSystem& moving_;
  const System& system_;
  const Model& model_;
  VectorXd u_;
  const MovingSystem::Forces& forces_;
  WholeBalance& balance_;
  VectorXd multipliers_;
  StaticSolution state_;
};

}  // namespace

StaticSolution postprocess_motion(const MovingSystem& moving, const VectorXd& q,
                                  const MovingSystem::Forces& forces, WholeBalance& balance) {
  return MotionPostprocessor(moving, q, forces, balance).run();
}

double mean_platform_rotation(const Model& model, const Eigen::MatrixX2d& position,
                              const Eigen::MatrixX3d& displacement) {
  std::array<Vector2d, 3> r;
  std::array<Vector2d, 3> u;
  for (std::size_t i = 0; i < 3; ++i) {
    const Index node = model.find_node("C" + std::to_string(i + 1));
    r[i] = position.row(node);
    u[i] = displacement.row(node).head<2>();
  }
  const Vector2d center = (r[0] + r[1] + r[2]) / 3;
  double turning = 0;
  double size = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    turning += cross(r[i] - center, u[i]);
    size += (r[i] - center).squaredNorm();
  }
  return turning / size;
}

}  // namespace trammel::solver
