#include "solver/large_motion/solve/rigid_member_velocities.h"

#include "solver/large_motion/elements/shape_functions.h"
#include "solver/model/numbers.h"

namespace trammel::solver::large_motion {

namespace {

/// Collects values of free coordinates, the last one wins.
class VelocityCollector {
 public:
  explicit VelocityCollector(const GeometricallyExactSystem& system)
      : value_(VectorXd::Zero(system.coordinates())),
        given_(to_size(system.coordinates()), false) {}

  void set(Index k, double value) {
    if (k < 0 || k >= value_.size()) return;
    value_[k] = value;
    given_[to_size(k)] = true;
  }

  [[nodiscard]] PrescribedVelocities prescribed() const {
    PrescribedVelocities all;
    for (Index k = 0; k < value_.size(); ++k) {
      if (given_[to_size(k)]) all.emplace_back(k, value_[k]);
    }
    return all;
  }

 private:
  VectorXd value_;
  std::vector<bool> given_;
};

void set_element(const GeometricallyExactSystem& system, const MemberElement& element,
                 const Eigen::MatrixX3d& node, double angular_velocity, VelocityCollector& given) {
  const Member& member = system.model().members[to_size(element.member)];
  const Vector2d& from = system.model().nodes[to_size(member.nodes[0])].position;
  const Vector2d along = system.model().nodes[to_size(member.nodes[1])].position - from;
  const std::size_t stride = element.is_bar() ? 2 : 3;
  const std::size_t count = element.coordinates.size() / stride;
  for (std::size_t a = 0; a < count; ++a) {
    const double x =
        element.is_bar() ? static_cast<double>(a) : lobatto_coordinate(system.order(), a);
    const Vector2d position = element.start + x * (element.end - element.start);
    const double s = (position - from).dot(along) / along.squaredNorm();
    for (Index k = 0; k < 2; ++k) {
      given.set(element.coordinates[stride * a + to_size(k)],
                (1 - s) * node(member.nodes[0], k) + s * node(member.nodes[1], k));
    }
    if (stride == 3) given.set(element.coordinates[stride * a + 2], angular_velocity);
  }
}

}  // namespace

PrescribedVelocities rigid_member_velocities(const GeometricallyExactSystem& system,
                                             const Eigen::MatrixX3d& node, const VectorXd& member) {
  VelocityCollector given(system);
  for (const MemberElement& element : system.layout().elements) {
    set_element(system, element, node, member[element.member], given);
  }
  for (Index i = 0; i < node.rows(); ++i) {
    for (Index k = 0; k < 3; ++k)
      given.set(system.layout().node[to_size(i)][to_size(k)], node(i, k));
  }
  return given.prescribed();
}

}  // namespace trammel::solver::large_motion
