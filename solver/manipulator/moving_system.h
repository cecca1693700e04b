#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/elements/frame_element.h"
#include "solver/linalg/dense_lu.h"
#include "solver/model/outcome.h"

namespace trammel::solver {

/// Rotation of a rigid part about the position in which the model was built.
struct PartMotion {
  double angle = 0;         ///< [rad]
  double rate = 0;          ///< [rad/s]
  double acceleration = 0;  ///< [rad/s^2]
};

/// The nominal motion: every member, plate and rigid body of a model moves as a rigid part.
struct NominalMotion {
  Eigen::MatrixX2d position;      ///< model node x (x, y) [m]
  Eigen::MatrixX2d acceleration;  ///< model node x (x, y) [m/s^2]
  std::vector<PartMotion> member, plate, rigid_body;
  Vector2d gravity = Vector2d::Zero();  ///< [m/s^2]
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
/// of T(t) are the `convective` effect, 2 W^T W. a damping matrix and W^T W.. a stiffness.
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
  /// - int rho W^T r.. dV, as a load [N, N m].
  [[nodiscard]] const Eigen::VectorXd& inertia_load() const { return inertia_load_; }
  /// Loads of the model, which keep their world axes, and weight.
  [[nodiscard]] const Eigen::VectorXd& load() const { return load_; }

  [[nodiscard]] const NominalMotion& motion() const { return motion_; }
  /// Nominal position of a node of the mesh [m].
  [[nodiscard]] Vector2d position(Index mesh_node) const;
  /// The model where it was built; its mesh, coordinates and numbering hold at every pose.
  [[nodiscard]] const System& start() const { return start_; }
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }

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

  [[nodiscard]] std::int64_t element_evaluations() const { return element_evaluations_; }

 private:
  using RowMajorMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  enum class Layout { frame, triangle, point_mass, scalar };  // what the coordinates are

  /// Matrices in the axes of the part at the start.
  struct Element {
    Layout layout = Layout::frame;
    std::array<Index, 6> coordinates{-1, -1, -1, -1, -1, -1};
    Matrix6d k = Matrix6d::Zero(), m = Matrix6d::Zero();
    Matrix6d first_derivative = Matrix6d::Zero();                  // int rho N^T dN/dangle
    Matrix6d second_derivative = Matrix6d::Zero();                 // int rho N^T d2N/dangle2
    const std::vector<PartMotion> NominalMotion::*part = nullptr;  // null: does not turn
    std::size_t part_index = 0;
    Vector2d first_moment = Vector2d::Zero();  // lump: mass * offset
    std::size_t first_contribution = 0;        // of its terms
  };
  /// value(destination) += T(a) * element(local) * T(b)
  struct Contribution {
    int local, a, b, destination;
  };

  void make_frames();
  void make_triangles();
  void make_point_masses();
  void make_springs();
  void extend_constraint_pattern();
  void make_pattern();
  void make_spans();
  [[nodiscard]] double coefficient(const ConstraintRow& row, std::size_t term,
                                   const NominalMotion& motion, int order) const;
  [[nodiscard]] bool constraints_move(const NominalMotion& motion) const;
  [[nodiscard]] Eigen::MatrixXd dependent_coordinates(const NominalMotion& motion);
  [[nodiscard]] Outcome solve_constraints(const NominalMotion& motion);
  [[nodiscard]] PartMotion part_of(const Element& element) const;
  [[nodiscard]] Matrix6d rotated_matrix(const Element& element, const Matrix6d& A,
                                        double turn) const;
  [[nodiscard]] Vector6d nominal_acceleration(const Element& element) const;
  [[nodiscard]] Vector6d weight(const Element& element, const Matrix6d& m) const;
  [[nodiscard]] Vector6d element_inertia_load(const Element& element, const Matrix6d& m) const;
  void add_gyroscopic(const Element& element, const PartMotion& part, const Matrix6d& m,
                      std::size_t end);

  System start_;
  Constraints constraints_;  // of the present pose
  bool gyroscopic_, inertia_;
  bool T_is_variable_ = false;  // T changes with the pose
  std::vector<Element> elements_;
  std::vector<Contribution> contributions_;
  SparseMatrix K_, M_, C_gyroscopic_, K_centrifugal_euler_;
  RowMajorMatrix T_dot_, T_ddot_;            // pattern of T
  std::vector<std::size_t> dependent_rows_;  // rows of C beside supports ...
  std::vector<Index> dependent_row_of_;  // ... and of each coordinate that they eliminate, or -1
  DenseLu pivots_;
  std::vector<std::array<Index, 2>> span_;  // mesh node -> ends of its member ...
  std::vector<double> fraction_;            // ... and where it lies between them
  NominalMotion motion_;
  Eigen::VectorXd inertia_u_, load_u_, inertia_load_, load_;
  std::int64_t element_evaluations_ = 0;
};

}  // namespace trammel::solver
