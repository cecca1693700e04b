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
  /// true: compute the mass matrix M; false: M is empty.
  bool inertia = true;
  /// true: also compute gyroscopic, centrifugal and Euler matrices.
  bool gyroscopic = false;
  /// true: replace members by condensed members (link_superelement.h) and compute no loads.
  bool condensed = false;
};

/// Finite element model of a moving manipulator: K, M and inertia loads as functions of the pose.
/// The matrices have the same sparsity pattern at all poses. Element matrices are computed once in
/// element axes. For each pose, the element matrices are rotated and added at precomputed
/// positions.
///
/// The elastic displacements u(t) = T(t) q(t) are components in world axes, relative to the moving
/// nominal position. W = R N T_s is the interpolation of an element in world axes, which rotates
/// with the element. T_s rotates the nodal displacements of the element to element axes. N
/// interpolates the rotated displacements within the element, and R rotates the interpolated
/// displacement to world axes. A dot denotes the time derivative. The virtual work of inertia is
///
///   int rho W^T (r.. + W u.. + 2 W. u. + W.. u) dV,
///
/// where r.. is the nominal acceleration. Varalakshmi & Srinivas (2017) include the first two
/// terms: inertia loads, Eq. 14-17, and the mass matrix. The last two terms follow from the time
/// derivatives of T_s and R. Together with the terms of the time derivatives of T(t), they form the
/// `gyroscopic` effect. 2 W^T W. yields a damping matrix, and W^T W.. a stiffness matrix. With this
/// effect, damping acts on u. = T q. + T. q. Without this effect, damping acts on T q. only.
class MovingSystem {
 public:
  /// Assembles the model at the pose at which the model was built.
  /// @throws ModelError  as `assemble`.
  explicit MovingSystem(const Model& model, const MovingSystemOptions& options = {});

  /// Computes matrices and loads for a nominal motion. The outcome is singular if the constraints
  /// do not determine the eliminated coordinates at the pose of the motion.
  [[nodiscard]] Outcome move_to(const NominalMotion& motion);

  // Matrices of the free coordinates q at the current pose, all with the same sparsity pattern.
  [[nodiscard]] const SparseMatrix& K() const { return K_; }
  [[nodiscard]] const SparseMatrix& M() const { return M_; }
  [[nodiscard]] const SparseMatrix& gyroscopic_matrix() const { return C_gyroscopic_; }
  [[nodiscard]] const SparseMatrix& centrifugal_and_euler_matrix() const {
    return K_centrifugal_euler_;
  }
  /// Returns the matrix T^T k dT/dt, where k is the stiffness matrix of the coordinates u. The
  /// matrix yields the stiffness-proportional damping forces of the velocity dT/dt q. The matrix is
  /// empty without the gyroscopic effect.
  [[nodiscard]] const SparseMatrix& K_T_dot() const { return K_T_dot_; }
  /// Returns the matrix T^T m dT/dt, where m is the mass matrix of the coordinates u. The matrix
  /// yields the mass-proportional damping forces of the velocity dT/dt q. The matrix is empty
  /// without the gyroscopic effect.
  [[nodiscard]] const SparseMatrix& M_T_dot() const { return M_T_dot_; }
  /// Returns the inertia load of the nominal motion, - int rho W^T r.. dV [N, N m]. W is the
  /// interpolation of an element, and r.. the nominal acceleration.
  [[nodiscard]] const Eigen::VectorXd& inertia_load() const { return inertia_load_; }
  /// Returns the weight plus the loads of the model [N, N m]. The loads have constant directions in
  /// world axes.
  [[nodiscard]] const Eigen::VectorXd& external_load() const { return load_; }

  [[nodiscard]] const NominalMotion& motion() const { return motion_; }
  /// Returns the nominal position of a mesh node [m].
  [[nodiscard]] Vector2d position(Index mesh_node) const {
    return interpolate_at_mesh_node(mesh_node, motion_.node[0]);
  }
  /// Returns the system at the pose at which the model was built. Its mesh, coordinates and
  /// numbering are valid at every pose.
  [[nodiscard]] const System& start() const { return start_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_.constraints(); }
  [[nodiscard]] const std::vector<MovingElement>& elements() const { return elements_; }
  /// Returns the condensed members in the order of the model. The list is empty without
  /// condensation.
  [[nodiscard]] const std::vector<LinkSuperelement>& links() const { return links_; }

  /// Forces of an elastic motion at the current pose, on all coordinates u.
  struct Forces {
    /// Forces of nodes on frame elements in element axes, 6 components x element.
    Eigen::MatrixXd element;
    /// Constraint forces: element forces, including inertia and damping forces, minus loads and
    /// weight.
    Eigen::VectorXd total;
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
  /// Contribution of an element matrix to an entry of an assembled matrix (K, M, ...):
  /// value(destination) += T(a) * element(local) * T(b).
  ///
  /// The entry (i, j) of the element matrix has the position local = i + 6 j. The positions a and b
  /// are indices of the value array of T, and `destination` is an index of the value array of the
  /// assembled matrix.
  struct Contribution {
    int local, a, b, destination;
  };
  /// Position of a mesh node between two model nodes. Linear interpolation between the model nodes
  /// is exact for rigid motion.
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
  // Index in `contributions_` of the first contribution of each element. The last value is the
  // number of all contributions.
  std::vector<std::size_t> first_contribution_;
  std::vector<Span> span_;  // position of each mesh node on its member
  SparseMatrix K_, M_, C_gyroscopic_, K_centrifugal_euler_, K_T_dot_, M_T_dot_;
  Eigen::VectorXd inertia_u_, load_u_, inertia_load_, load_;
};

/// Rigid motion of a manipulator on its path at a time, and the elastic system relative to this
/// motion.
class PathFollower {
 public:
  /// Builds the model at the pose of the time `built_at` [s] and numbers its coordinates.
  /// @pre `options` must outlive this object.
  PathFollower(const ElastodynamicsOptions& options, double built_at);

  /// Updates pose, matrices and loads to a time. Repeated calls for the same time do nothing. If
  /// the platform is at rest and the load is constant, pose, matrices and loads are computed only
  /// once.
  /// @returns false on failure; then `outcome` states the time and the reason.
  bool update_to(double time);
  /// Updates pose, matrices and loads to a time with any gravity [m/s^2]. Results of earlier calls
  /// are not reused.
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
  // coordinates q.

  /// Returns the weight and the load on the platform plus, if active, the inertia load of the
  /// nominal motion [N, N m].
  [[nodiscard]] Eigen::VectorXd load() const;
  /// Computes the matrices M, C + G and K + S of acceleration, velocity and displacement
  /// (elastodynamics.h). They include damping forces of the velocity dT/dt q. C is not modified
  /// without damping and gyroscopic terms.
  void compute_matrices(SparseMatrix& M, SparseMatrix& C, SparseMatrix& K);
  /// Solves K q = f. Returns false if K is singular.
  [[nodiscard]] bool solve_statically(const Eigen::VectorXd& f, Eigen::VectorXd& q);
  /// Returns (f^T K^-1 f)^(1/2) [J^(1/2)], the square root of twice the strain energy under the
  /// load f alone. The result is NaN if K is singular.
  [[nodiscard]] double energy_norm(const Eigen::VectorXd& f);
  /// Returns the actuator torques of a manipulator with rigid links under the weight and the wrench
  /// [N m]. The torques include the nominal inertia if this effect is active.
  [[nodiscard]] Vector3d rigid_torque() const;

  /// Returns the numbers of element evaluations, factorizations and solutions, and the number of
  /// evaluations of each effect. Damping and gyroscopic effects are counted each time their
  /// matrices are computed, and all other effects once per analysis.
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
