#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "solver/assembly/system.h"
#include "solver/elastodynamics/moving_constraints.h"
#include "solver/manipulator/manipulator.h"
#include "solver/poses/dense_ldlt.h"
#include "solver/poses/link_superelement.h"

namespace trammel::solver {

/// Vectors in the coordinates of a MovingPencil, side by side: row x coordinate. A step of
/// arithmetic is the same for all rows, and their number is known when it is compiled.
template <int rows>
struct VectorBlock {
  Eigen::Matrix<double, rows, Eigen::Dynamic> ends;    ///< free coordinates of the joints
  Eigen::Matrix<double, rows, Eigen::Dynamic> inside;  ///< modes inside the links, link by link
};

/// Displacements of and forces on the unconstrained coordinates, magnitudes and products of
/// vectors, kept so that nothing allocates.
template <int rows>
struct Workspace {
  Eigen::Matrix<double, rows, Eigen::Dynamic> U, F, sizes;
  VectorBlock<rows> image;
};

/// Energies and equation residuals of vectors that are taken for modes, one number a row.
template <int rows>
struct ModeMeasures {
  using Numbers = Eigen::Array<double, rows, 1>;
  Numbers strain;    ///< x^T K x from the deformations
  Numbers rounding;  ///< 2 eps sum |d|^T c |B||u|, what rounding x can do to it
  Numbers inertia;   ///< x^T M x
  /// Largest ratio of a row of (K - strain / inertia M) x and the magnitudes of its terms.
  Numbers backward_error;
};

/// K and M of one manipulator as functions of its pose. Each link is condensed once, exactly
/// (LinkSuperelement); platform, masses and springs have one matrix each in their own axes. A pose
/// turns them and adds them up: to K and M of the joints' coordinates, a dozen or two. Modes inside
/// the links have stiffness 1 and follow by inertia alone.
class MovingPencil {
 public:
  /// @param model  at the pose, with as many elements a link as it is to have; without effects that
  ///               are off
  MovingPencil(const Model& model, const ManipulatorGeometry& geometry, const Pose& pose);

  /// singular: the coordinates that the constraints eliminate do not suit this pose.
  [[nodiscard]] Outcome move_to(const Posture& posture, const Pose& pose);

  [[nodiscard]] Index ends() const { return K_.rows(); }
  [[nodiscard]] Index inside() const { return inside_; }
  /// Free coordinates of the model as it is, those inside that carry no mass too.
  [[nodiscard]] Index free_coordinates() const { return free_coordinates_; }
  [[nodiscard]] const Counters& counters() const { return start_.counters; }
  [[nodiscard]] double coupling() const { return coupling_; }  ///< of the links, the largest

  /// At the present pose, lower triangles.
  [[nodiscard]] const Eigen::MatrixXd& K() const { return K_; }
  /// Eigenvalues of the whole model below `shift`, by the inertia of K - shift M: of its inside,
  /// and of what is left of it on the joints' coordinates (Wittrick & Williams 1971); -1 where the
  /// pivots have lost their digits.
  [[nodiscard]] Index eigenvalues_below(double shift);

  /// Y = X M.
  template <int rows>
  void mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y, Workspace<rows>& space) const;
  template <int rows>
  [[nodiscard]] ModeMeasures<rows> measure(const VectorBlock<rows>& X,
                                           Workspace<rows>& space) const;

 private:
  /// Coordinates that turn with a part; B, c, m and P in axes that lie in the part.
  struct Element {
    std::array<Index, 6> coordinates{-1, -1, -1, -1, -1, -1};
    FrameDeformation B = FrameDeformation::Zero();
    Vector3d c = Vector3d::Zero();
    Matrix6d k = Matrix6d::Zero(), m = Matrix6d::Zero();
    enum class Part { ground, link, platform } part = Part::ground;
    std::size_t index = 0;  ///< of the link
    Index stride = 0;       ///< from one pair (x, y) of coordinates to the next; 0: there is none
    Index pairs = 0;        ///< of coordinates that turn
    std::size_t first = 0, last = 0;  ///< its contributions
  };
  /// sum(i, j) += T(a) * matrix(local) * T(b), i >= j
  struct Contribution {
    int local, a, b, i, j;
  };
  struct Link {
    LinkSuperelement condensed;
    Index first_inside = 0;  ///< in VectorBlock::inside
    struct Coupling {
      Index mode, coordinate;
      double value;
    };
    std::vector<Coupling> couplings;  ///< of P, without its zeros
  };

  template <int rows>
  using Rows = Eigen::Matrix<double, rows, Eigen::Dynamic>;
  template <int rows>
  using Local = Eigen::Matrix<double, rows, 6>;

  void add_links(const std::vector<Index>& elements);
  void add_platform();
  void add_springs();
  void find_contributions();
  [[nodiscard]] Vector2d direction(const Element& element) const;
  void add(const Element& element, const Matrix6d& A, Eigen::MatrixXd& sum) const;
  template <int rows>
  [[nodiscard]] Local<rows> gather(const Element& element, const Rows<rows>& U) const;
  template <int rows>
  void displacements(const Rows<rows>& X, Rows<rows>& U) const;
  template <int rows>
  void measure_strain(const VectorBlock<rows>& X, const Rows<rows>& U,
                      ModeMeasures<rows>& measures) const;
  template <int rows>
  void measure_residual(const VectorBlock<rows>& X, Workspace<rows>& space,
                        ModeMeasures<rows>& measures) const;

  System start_;
  MovingConstraints constraints_;
  NominalMotion motion_, next_;
  Posture start_posture_;
  double start_phi_ = 0;
  std::vector<Element> elements_;
  std::vector<Contribution> contributions_;
  std::vector<Link> links_;
  std::array<Vector2d, 6> link_direction_;
  Vector2d platform_direction_ = Vector2d::UnitX();
  Index inside_ = 0, free_coordinates_ = 0;
  double coupling_ = 0;
  Eigen::VectorXd length_;  // that a coordinate is multiplied by to compare: 1, or of the model
  Eigen::MatrixXd K_, M_, shifted_;
  DenseLdlt count_;
};

}  // namespace trammel::solver
