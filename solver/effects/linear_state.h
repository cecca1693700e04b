#pragma once

#include <array>
#include <vector>

#include "solver/assembly/prestress.h"
#include "solver/assembly/system.h"
#include "solver/linalg/factorization.h"
#include "solver/statics/statics.h"

/// A linear solution, and how small loads change it.
namespace trammel::solver {

/// What a solution consists of, by kind: each kind is compared with its largest.
struct StateResults {
  static constexpr std::size_t kKinds = 4;  ///< displacement, rotation, force, moment
  std::array<std::vector<double>, kKinds> values;

  void append(const StateResults& other) {
    for (std::size_t k = 0; k < kKinds; ++k) {
      values[k].insert(values[k].end(), other.values[k].begin(), other.values[k].end());
    }
  }
  [[nodiscard]] double largest(std::size_t kind) const {
    double largest_value = 0;
    for (const double value : values[kind])
      largest_value = std::max(largest_value, std::abs(value));
    return largest_value;
  }
};

/// A change of the state: displacements and the forces on the elements' ends, in their axes.
struct StateChange {
  Eigen::VectorXd u;
  std::vector<Vector6d> force;
  double undirected_displacement = 0;  ///< a further displacement, of unknown direction [m]
  double indeterminate_force = 0;      ///< a force that is lost [N]
};

class LinearState {
 public:
  /// Without inertia. @post solution.outcome tells whether the rest has values
  LinearState(const Model& model, Effects applicable);

  [[nodiscard]] const Member& member_of(const FrameElement& e) const {
    return system.model.members[to_size(e.member)];
  }
  [[nodiscard]] Vector3d rigidity(const FrameElement& e) const;
  [[nodiscard]] Vector6d geometric_forces(const FrameElement& e, double axial,
                                          double axial_variation,
                                          const Eigen::VectorXd& motion) const;

  /// K^-1 of a load on the unconstrained coordinates.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& load);
  /// End forces of displacements.
  [[nodiscard]] std::vector<Vector6d> elastic(const Eigen::VectorXd& motion) const;
  /// u^T K u [J].
  [[nodiscard]] double twice_strain_energy() const;
  /// At the nodes that have names and the ends of the members.
  [[nodiscard]] StateResults results_of(const Eigen::VectorXd& motion,
                                        const std::vector<Vector6d>& force) const;

  System system;
  StaticSolution solution;
  Eigen::VectorXd u;
  Prestress forces;
  std::vector<Vector6d> base;  ///< end forces
  Counters counters;

 private:
  Factorization factorization_;
};

/// End forces, in element axes, of forces that go with the element's deformations.
[[nodiscard]] Vector6d end_forces(const FrameElement& e, const Vector3d& of_deformations);
/// Of a uniform load [N/m, world axes], in element axes.
[[nodiscard]] Vector6d local_load(const FrameElement& e, const Vector2d& load);

}  // namespace trammel::solver
