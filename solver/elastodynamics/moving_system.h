#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/elastodynamics/member_interpolation.h"
#include "solver/elastodynamics/moving_constraints.h"
#include "solver/elastodynamics/moving_element.h"
#include "solver/elastodynamics/moving_pattern.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// A model whose parts move: K, M and loads of inertia as functions of the pose, on one pattern.
/// Element matrices are evaluated once, in the axes of their parts; a pose rotates them and adds
/// them up at places found once.
///
/// The elastic displacements u(t) = T(t) q(t) are components in world axes and are measured from
/// the moving nominal position. With W the interpolation of an element in world axes, which turns
/// with its part (W = R N T_s), the virtual work of inertia is
///   int rho W^T (r.. + W u.. + 2 W. u. + W.. u) dV,
/// r.. the nominal acceleration. The paper keeps the first two terms: loads of inertia, Eq. 14-17,
/// and the mass. The other two come from the time derivative of T_s and R; they and the same terms
/// of T(t) are the `gyroscopic` effect, 2 W^T W. a damping matrix and W^T W.. a stiffness. With
/// them damping acts on all of u. = T q. + T. q; without, on T q. alone.
class MovingSystem {
 public:
  /// @param inertia  false: no M, and none of the start
  /// @throws ModelError  as `assemble`.
  explicit MovingSystem(const Model& model, bool gyroscopic = false, bool inertia = true);

  /// singular: the coordinates that the constraints eliminate do not suit this pose.
  [[nodiscard]] Outcome move_to(const NominalMotion& motion);

  // Free coordinates q, at the present pose; the matrices share one pattern.
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& gyroscopic_matrix() const { return C_gyroscopic_; }
  [[nodiscard]] const SparseMatrix& centrifugal_and_euler_matrix() const {
    return K_centrifugal_euler_;
  }
  /// T^T k T. and T^T m T. of the elements: what damping takes of T. q; gyroscopic effect.
  [[nodiscard]] const SparseMatrix& K_T_dot() const { return K_T_dot_; }
  [[nodiscard]] const SparseMatrix& M_T_dot() const { return M_T_dot_; }
  /// - int rho W^T r.. dV, as a load [N, N m].
  [[nodiscard]] const Eigen::VectorXd& inertia_load() const { return inertia_load_; }
  /// Loads of the model, which keep their world axes, and weight.
  [[nodiscard]] const Eigen::VectorXd& load() const { return load_; }

  [[nodiscard]] const NominalMotion& motion() const { return motion_; }
  /// Nominal position of a node of the mesh [m].
  [[nodiscard]] Vector2d position(Index mesh_node) const {
    return interpolation_.at(mesh_node, motion_.position);
  }
  /// The model where it was built; its mesh, coordinates and numbering hold at every pose.
  [[nodiscard]] const System& start() const { return start_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_.constraints(); }

  /// A motion and what energies are made of, on all coordinates u at the present pose.
  struct ElasticMotion {
    Eigen::VectorXd u, velocity;    ///< T q and T q. + T. q
    Eigen::VectorXd Ku, Kv, Mv;     ///< of the elements, v the velocity
    Eigen::VectorXd load, inertia;  ///< loads and weight; of the nominal motion
  };
  [[nodiscard]] ElasticMotion elastic_motion(const Eigen::VectorXd& q,
                                             const Eigen::VectorXd& v) const;

  /// Forces at the ends of the frame elements and on all coordinates u, at the present pose.
  struct Forces {
    Eigen::MatrixXd element;   ///< 6 x frame element: what its nodes do to it, element axes
    Eigen::VectorXd total;     ///< what constraints must give: the elements' needs less the loads
    Eigen::VectorXd external;  ///< loads and weight, less inertia and the damping by mass, on u
  };
  /// @param q, v, a  free coordinates and their rates;
  /// @param mass_damping, stiffness_damping  Rayleigh's factors [1/s], [s]
  /// @param with_inertia  of the nominal motion
  [[nodiscard]] Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a, double mass_damping,
                              double stiffness_damping, bool with_inertia) const;

  [[nodiscard]] std::int64_t element_evaluations() const {
    return 2 * (std::ssize(start_.mesh.frame) + std::ssize(start_.model.triangles));
  }

 private:
  [[nodiscard]] Vector6d nominal_acceleration(const MovingElement& element) const;
  [[nodiscard]] Vector6d weight(const MovingElement& element, const Matrix6d& m) const;
  [[nodiscard]] Vector6d element_inertia_load(const MovingElement& element,
                                              const Matrix6d& m) const;
  void add_stiffness_and_mass(std::size_t index, const Matrix6d& k, const Matrix6d& m);
  void add_gyroscopic(std::size_t index, const PartMotion& part, const Matrix6d& k,
                      const Matrix6d& m);
  [[nodiscard]] Eigen::VectorXd velocity(const Eigen::VectorXd& q, const Eigen::VectorXd& v) const;

  System start_;
  bool gyroscopic_, inertia_;
  NominalMotion motion_;
  MovingConstraints constraints_;
  std::vector<MovingElement> elements_;
  MovingPattern pattern_;
  MemberInterpolation interpolation_;
  SparseMatrix K_, M_, C_gyroscopic_, K_centrifugal_euler_, K_T_dot_, M_T_dot_;
  Eigen::VectorXd inertia_u_, load_u_, inertia_load_, load_;
};

}  // namespace trammel::solver
