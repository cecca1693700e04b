#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "solver/linalg/factorization.h"
#include "solver/linear/row_balance.h"
#include "solver/linear/system.h"
#include "solver/manipulator/elastodynamics.h"
#include "solver/manipulator/moving_constraints.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/evidence.h"
#include "solver/motion/equation_of_motion.h"

namespace trammel::solver {

struct MovingSystemOptions {
  bool inertia = true;      ///< false: no M, and no inertia where the model was built
  bool gyroscopic = false;  ///< matrices of the rates of the parts, too
  bool condensed = false;   ///< members are condensed (link_superelement.h); no loads
};

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
  /// @throws ModelError  as `assemble`.
  explicit MovingSystem(const Model& model, const MovingSystemOptions& options = {});

  /// singular: the coordinates that the constraints eliminate do not suit this pose.
  [[nodiscard]] Outcome move_to(const NominalMotion& motion);

  // Free coordinates q, at the present pose; the matrices share one pattern.
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& gyroscopic_matrix() const { return C_gyroscopic_; }
  [[nodiscard]] const SparseMatrix& centrifugal_and_euler_matrix() const {
    return K_centrifugal_euler_;
  }
  /// T^T k T. and T^T m T. of the elements: damping forces of T. q; gyroscopic effect.
  [[nodiscard]] const SparseMatrix& K_T_dot() const { return K_T_dot_; }
  [[nodiscard]] const SparseMatrix& M_T_dot() const { return M_T_dot_; }
  /// - int rho W^T r.. dV, as a load [N, N m].
  [[nodiscard]] const Eigen::VectorXd& inertia_load() const { return inertia_load_; }
  /// Loads of the model, which keep their world axes, and weight.
  [[nodiscard]] const Eigen::VectorXd& load() const { return load_; }

  [[nodiscard]] const NominalMotion& motion() const { return motion_; }
  /// Nominal position of a node of the mesh [m].
  [[nodiscard]] Vector2d position(Index mesh_node) const {
    return at_mesh_node(mesh_node, motion_.node[0]);
  }
  /// The model where it was built; its mesh, coordinates and numbering hold at every pose.
  [[nodiscard]] const System& start() const { return start_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_.constraints(); }
  [[nodiscard]] const std::vector<MovingElement>& elements() const { return elements_; }
  /// Condensed members, in the order of the model; empty unless condensed.
  [[nodiscard]] const std::vector<LinkSuperelement>& links() const { return links_; }

  /// Forces of an elastic motion at the present pose, on all coordinates u.
  struct Forces {
    Eigen::MatrixXd element;   ///< 6 x frame element: forces of its nodes on it, element axes
    Eigen::VectorXd total;     ///< required constraint forces: elements' forces less the loads
    Eigen::VectorXd external;  ///< loads and weight, less inertia and the damping by mass
    WorkingMotion working;     ///< energies, and the forces that do work
  };
  /// @param q, v, a  free coordinates and their rates.
  /// @param with_inertia  of the nominal motion.
  [[nodiscard]] Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a, const RayleighDamping& damping,
                              bool with_inertia) const;

  [[nodiscard]] std::int64_t element_evaluations() const {
    return 2 * (std::ssize(start_.mesh.frame) + std::ssize(start_.model.triangles));
  }

 private:
  /// value(destination) += T(a) * element(local) * T(b), local = i + 6 j.
  struct Contribution {
    int local, a, b, destination;
  };
  /// Linear between the ends of a member, as every affine field is.
  struct Span {
    std::array<Index, 2> nodes{};
    double fraction = 0;
  };

  void find_spans();
  void find_pattern();
  void add_matrices(std::size_t index);
  void add_gyroscopic(std::size_t index, const Matrix6d& k, const Matrix6d& m);
  void add_loads(const MovingElement& element);
  [[nodiscard]] Vector2d at_mesh_node(Index mesh_node, const Eigen::MatrixX2d& values) const;
  [[nodiscard]] Vector6d nominal_inertia(const MovingElement& element, const PartMotion& part,
                                         const Vector2d& direction) const;
  [[nodiscard]] Vector6d weight(const MovingElement& element, const Vector2d& direction) const;

  MovingSystemOptions options_;
  System start_;
  NominalMotion motion_;
  MovingConstraints constraints_;
  std::vector<LinkSuperelement> links_;
  std::vector<MovingElement> elements_;
  std::vector<Contribution> contributions_;
  std::vector<std::size_t> first_contribution_;  // of each element, and their number
  std::vector<Span> span_;                       // of each node of the mesh
  SparseMatrix K_, M_, C_gyroscopic_, K_centrifugal_euler_, K_T_dot_, M_T_dot_;
  Eigen::VectorXd inertia_u_, load_u_, inertia_load_, load_;
};

/// The manipulator on its way along the path: the rigid motion at a time, and the elastic system
/// about it.
class PathFollower {
 public:
  /// @param built_at  the time at whose pose the model is built and its coordinates are numbered
  /// [s]
  /// @pre `options` outlive the follower
  PathFollower(const ElastodynamicsOptions& options, double built_at);

  /// A time is evaluated once, and only one for a platform that stands still under a load that
  /// stays.
  /// @returns false: `outcome` names the time and the reason.
  bool update_to(double time);
  /// The same at any time under any gravity [m/s^2], each time anew.
  [[nodiscard]] Outcome move_to(double time, const Vector2d& gravity);

  [[nodiscard]] const MovingSystem& system() const { return moving_; }
  /// Forces and energies of an elastic motion at the present pose.
  [[nodiscard]] MovingSystem::Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            const Eigen::VectorXd& a) const {
    return moving_.forces(q, v, a, options_.damping, options_.nominal_inertia);
  }
  [[nodiscard]] const TrajectoryPoint& point() const { return point_; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] bool stands_still() const { return stands_still_; }
  [[nodiscard]] bool damped() const;

  // At the present pose, in free coordinates.

  /// F and, where it is on, f [N, N m].
  [[nodiscard]] Eigen::VectorXd load() const;
  /// M, C + G and K + S, with what damping takes of T. q; C stays as it is where nothing goes with
  /// velocities.
  void matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K);
  /// K q = f; false where K is singular.
  [[nodiscard]] bool solve_statically(const Eigen::VectorXd& f, Eigen::VectorXd& q);
  /// (f^T K^-1 f)^(1/2), twice the energy that the load f alone would store [J^(1/2)]; NaN where K
  /// is singular.
  [[nodiscard]] double energy_norm(const Eigen::VectorXd& f);
  /// Torques of rigid links under the same loads and, where it is on, the same inertia [N m].
  [[nodiscard]] Vector3d rigid_torque() const;

  /// Elements, what was solved with K, and the effects: what the parts have, once; what only the
  /// motion has, each time.
  [[nodiscard]] Counters counters() const;

 private:
  [[nodiscard]] Vector3d wrench(double time) const;

  const ElastodynamicsOptions& options_;
  bool stands_still_;
  RigidManipulator rigid_;
  MovingSystem moving_;
  SparseLdlt stiffness_{SparseLdlt::Triangle::mean};
  bool factored_ = false, regular_ = false;
  Counters counters_;
  Vector9d start_;
  double time_ = kNaN;
  TrajectoryPoint point_;
  InverseDynamics dynamics_;
  Outcome outcome_;
};

}  // namespace trammel::solver
