#pragma once

#include <Eigen/Core>
#include <array>
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

/// Options of the matrices and loads of a moving system.
struct MovingSystemOptions {
  bool inertia = true;      ///< false: no mass matrix M
  bool gyroscopic = false;  ///< true: also gyroscopic, centrifugal and Euler matrices
  bool condensed = false;   ///< true: condensed members (link_superelement.h), without loads
};

/// Finite element model of a moving manipulator: K, M and inertia loads as functions of the pose.
/// The matrices have the same sparsity pattern at all poses. Element matrices are computed once in
/// element axes. For each pose they are rotated and added at precomputed positions.
///
/// The elastic displacements u(t) = T(t) q(t) are components in world axes, relative to the moving
/// nominal position. W = R N T_s is the interpolation of an element in world axes, which rotates
/// with the element. T_s rotates the displacements of its nodes to element axes. N interpolates
/// them within the element, and R rotates the result to world axes. A dot denotes the time
/// derivative. The virtual work of inertia is
///
///   int rho W^T (r.. + W u.. + 2 W. u. + W.. u) dV,
///
/// where r.. is the nominal acceleration. Varalakshmi & Srinivas (2017) keep the first two terms:
/// inertia loads, Eq. 14-17, and the mass. The last two terms follow from the time derivatives of
/// T_s and R. Together with the same terms of T(t) they form the `gyroscopic` effect. 2 W^T W. is a
/// damping matrix, and W^T W.. a stiffness matrix. With this effect, damping acts on u. = T q. + T.
/// q. Without it, damping acts on T q. only.
class MovingSystem {
 public:
  /// Assembles the model at its pose.
  /// @throws ModelError  as `assemble`.
  explicit MovingSystem(const Model& model, const MovingSystemOptions& options = {});

  /// Computes matrices and loads for a nominal motion. The outcome is singular if the constraints
  /// do not determine the eliminated coordinates at this pose.
  [[nodiscard]] Outcome move_to(const NominalMotion& motion);

  // Matrices of the free coordinates q at the current pose, all with the same sparsity pattern.
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& gyroscopic_matrix() const { return C_gyroscopic_; }
  [[nodiscard]] const SparseMatrix& centrifugal_and_euler_matrix() const {
    return K_centrifugal_euler_;
  }
  /// Returns the product of T^T, the stiffness matrix k of the coordinates u, and dT/dt. It yields
  /// the stiffness-proportional damping forces of the velocity dT/dt q. It is empty without the
  /// gyroscopic effect.
  [[nodiscard]] const SparseMatrix& K_T_dot() const { return K_T_dot_; }
  /// Returns the product of T^T, the mass matrix m of the coordinates u, and dT/dt. It yields the
  /// mass-proportional damping forces of the velocity dT/dt q. It is empty without the gyroscopic
  /// effect.
  [[nodiscard]] const SparseMatrix& M_T_dot() const { return M_T_dot_; }
  /// Returns the inertia load of the nominal motion, - int rho W^T r.. dV [N, N m].
  [[nodiscard]] const Eigen::VectorXd& inertia_load() const { return inertia_load_; }
  /// Returns the weight plus the loads of the model, which are constant in world axes [N, N m].
  [[nodiscard]] const Eigen::VectorXd& external_load() const { return load_; }

  [[nodiscard]] const NominalMotion& motion() const { return motion_; }
  /// Returns the nominal position of a mesh node [m].
  [[nodiscard]] Vector2d position(Index mesh_node) const {
    return interpolate_at_mesh_node(mesh_node, motion_.node[0]);
  }
  /// Returns the system at the start pose. Its mesh, coordinates and numbering are valid at every
  /// pose.
  [[nodiscard]] const System& start() const { return start_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_.constraints(); }
  [[nodiscard]] const std::vector<MovingElement>& elements() const { return elements_; }
  /// Returns the condensed members in the order of the model; empty without condensation.
  [[nodiscard]] const std::vector<LinkSuperelement>& links() const { return links_; }

  /// Forces of an elastic motion at the current pose, on all coordinates u.
  struct Forces {
    Eigen::MatrixXd element;   ///< 6 x frame element: forces of nodes on elements, element axes
    Eigen::VectorXd total;     ///< constraint forces: forces of the elements minus loads
    Eigen::VectorXd external;  ///< loads and weight, minus inertia and mass-proportional damping
    WorkingMotion working;     ///< energies, and the forces that do work
  };
  /// Computes the forces of an elastic motion (free coordinates q, velocities v, accelerations a)
  /// with Rayleigh damping. `with_inertia` includes inertia loads of the nominal motion.
  [[nodiscard]] Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                              const Eigen::VectorXd& a, const RayleighDamping& damping,
                              bool with_inertia) const;

  [[nodiscard]] std::int64_t evaluations_per_pose() const {
    return 2 * (std::ssize(start_.mesh.frame) + std::ssize(start_.model.triangles));
  }

 private:
  /// Contribution of an element matrix to an entry of K, M and the other matrices:
  /// value(destination) += T(a) * element(local) * T(b).
  ///
  /// The entry (i, j) of the element matrix has the position local = i + 6 j. The positions a, b
  /// and destination refer to the arrays of the values of T and of the matrix.
  struct Contribution {
    int local, a, b, destination;
  };
  /// Position of a mesh node between two model nodes. Linear interpolation of the rigid motion is
  /// exact.
  struct Span {
    std::array<Index, 2> nodes{};
    double fraction = 0;
  };

  void locate_mesh_nodes();
  void find_pattern();
  void add_matrices(std::size_t index);
  void add_gyroscopic_matrices(std::size_t index, const Matrix6d& k, const Matrix6d& m);
  void add_loads(const MovingElement& element);
  [[nodiscard]] Vector2d interpolate_at_mesh_node(Index mesh_node,
                                                  const Eigen::MatrixX2d& values) const;
  [[nodiscard]] Vector6d element_inertia_load(const MovingElement& element, const PartMotion& part,
                                              const Vector2d& direction) const;
  [[nodiscard]] Vector6d weight(const MovingElement& element, const Vector2d& direction) const;

  MovingSystemOptions options_;
  System start_;
  NominalMotion motion_;
  MovingConstraints constraints_;
  std::vector<LinkSuperelement> links_;
  std::vector<MovingElement> elements_;
  std::vector<Contribution> contributions_;
  // Index in `contributions_` of the first contribution of each element. The last entry is the
  // number of all contributions.
  std::vector<std::size_t> first_contribution_;
  std::vector<Span> span_;  // position of each mesh node on its member
  SparseMatrix K_, M_, C_gyroscopic_, K_centrifugal_euler_, K_T_dot_, M_T_dot_;
  Eigen::VectorXd inertia_u_, load_u_, inertia_load_, load_;
};

/// Manipulator on its path: the rigid motion at a time, and the elastic system relative to this
/// motion.
class PathFollower {
 public:
  /// Builds the model at the pose of the time `built_at` [s] and numbers its coordinates.
  /// @pre `options` outlive this object.
  PathFollower(const ElastodynamicsOptions& options, double built_at);

  /// Updates pose, matrices and loads to a time. Repeated calls for the same time do nothing. A
  /// platform at rest under a constant load is evaluated once.
  /// @returns false on failure; then `outcome` states the time and the reason.
  bool update_to(double time);
  /// Updates pose, matrices and loads to a time with any gravity [m/s^2]. Earlier evaluations are
  /// not reused.
  [[nodiscard]] Outcome move_to(double time, const Vector2d& gravity);

  [[nodiscard]] const MovingSystem& system() const { return moving_; }
  /// Returns forces and energies of an elastic motion at the current pose.
  [[nodiscard]] MovingSystem::Forces forces(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                                            const Eigen::VectorXd& a) const {
    return moving_.forces(q, v, a, options_.damping, options_.nominal_inertia);
  }
  [[nodiscard]] const TrajectoryPoint& platform_state() const { return point_; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }
  [[nodiscard]] bool is_at_rest() const { return is_at_rest_; }
  [[nodiscard]] bool is_damped() const;

  // Loads, matrices and static solutions at the current pose of the manipulator, in free
  // coordinates.

  /// Returns the weight and the load on the platform plus, if active, the inertia load of the
  /// nominal motion [N, N m].
  [[nodiscard]] Eigen::VectorXd load() const;
  /// Computes M, C + G and K + S (elastodynamics.h), including damping forces of the velocity dT/dt
  /// q. C is unchanged without damping and gyroscopic terms.
  void compute_matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K);
  /// Solves K q = f. Returns false if K is singular.
  [[nodiscard]] bool solve_statically(const Eigen::VectorXd& f, Eigen::VectorXd& q);
  /// Returns (f^T K^-1 f)^(1/2) [J^(1/2)], the square root of twice the strain energy under the
  /// load f alone. NaN if K is singular.
  [[nodiscard]] double energy_norm(const Eigen::VectorXd& f);
  /// Returns the actuator torques with rigid links, the same loads and, if active, nominal inertia
  /// [N m].
  [[nodiscard]] Vector3d rigid_torque() const;

  /// Returns the numbers of element evaluations, factorizations and solutions, and the evaluations
  /// that effects cause. Damping and gyroscopic effects count each time their matrices are
  /// computed, and other effects once in an analysis.
  [[nodiscard]] Counters counters() const;

 private:
  [[nodiscard]] Vector3d wrench(double time) const;

  const ElastodynamicsOptions& options_;
  bool is_at_rest_;
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
