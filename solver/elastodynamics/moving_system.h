#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>
#include <vector>

#include "solver/assembly/damping.h"
#include "solver/assembly/system.h"
#include "solver/elastodynamics/moving_constraints.h"
#include "solver/elastodynamics/moving_element.h"
#include "solver/model/outcome.h"
#include "solver/time/equation_of_motion.h"

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
  /// @param q, v, a  free coordinates and their rates
  /// @param with_inertia  of the nominal motion
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

}  // namespace trammel::solver
