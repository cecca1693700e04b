#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/elastodynamics/moving_system.h"
#include "solver/poses/dense_ldlt.h"

namespace trammel::solver {

/// Vectors in the coordinates of a MovingPencil, side by side: row x coordinate. A step of
/// arithmetic is the same for all rows, and their number is known when it is compiled.
template <int rows>
struct VectorBlock {
  Eigen::Matrix<double, rows, Eigen::Dynamic> ends;    ///< free coordinates of the joints
  Eigen::Matrix<double, rows, Eigen::Dynamic> inside;  ///< modes inside the links, link by link
};

/// Temporary blocks, kept so that no step allocates memory.
template <int rows>
struct Workspace {
  Eigen::Matrix<double, rows, Eigen::Dynamic> U, sizes;
  VectorBlock<rows> image;
};

/// Energies and equation residuals of approximate modes, one number a row.
template <int rows>
struct ModeMeasures {
  using Numbers = Eigen::Array<double, rows, 1>;
  Numbers strain;    ///< x^T K x from the deformations
  Numbers rounding;  ///< 2 eps sum |d|^T c |B||u|, the effect of rounding x on it
  Numbers inertia;   ///< x^T M x
  /// Largest ratio of a row of (K - strain / inertia M) x and the magnitudes of its terms.
  Numbers backward_error;
};

/// K and M of one manipulator as functions of its pose, with condensed links: matrices of the
/// joints' coordinates, a dozen or two, and the modes inside the links, which have stiffness 1 and
/// follow by inertia alone.
class MovingPencil {
 public:
  /// @param model  at the pose, with the number of elements a link that are condensed; without
  ///               inactive effects
  MovingPencil(const Model& model, const ManipulatorGeometry& geometry, const Pose& pose);

  /// singular: the coordinates that the constraints eliminate do not suit this pose.
  [[nodiscard]] Outcome move_to(const Posture& posture, const Pose& pose);

  [[nodiscard]] Index ends() const { return K_.rows(); }
  [[nodiscard]] Index inside() const { return mu_.size(); }
  /// Free coordinates of the model as it is, those inside that carry no mass too.
  [[nodiscard]] Index free_coordinates() const { return free_coordinates_; }
  [[nodiscard]] const Counters& counters() const { return system_.start().counters; }
  [[nodiscard]] double coupling() const { return coupling_; }  ///< of the links, the largest

  /// Stiffness of the joints' coordinates at the present pose.
  [[nodiscard]] const Eigen::MatrixXd& K() const { return K_; }
  /// Eigenvalues of the full model below `shift`, by the inertia of K - shift M: of its inside, and
  /// of its Schur complement on the joints' coordinates (Wittrick & Williams 1971); -1 where the
  /// pivots have lost their digits.
  [[nodiscard]] Index eigenvalues_below(double shift);

  /// Y = X M.
  template <int rows>
  void mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y) const;
  template <int rows>
  [[nodiscard]] ModeMeasures<rows> measure(const VectorBlock<rows>& X,
                                           Workspace<rows>& space) const;

 private:
  struct Link {
    Index first = 0, last = 0;  ///< of its modes in VectorBlock::inside
    std::vector<Index> ends;    ///< free coordinates that move its ends
  };

  template <int rows>
  void measure_strain(const VectorBlock<rows>& X,
                      const Eigen::Matrix<double, rows, Eigen::Dynamic>& U,
                      ModeMeasures<rows>& measures) const;
  template <int rows>
  void measure_residual(const VectorBlock<rows>& X, Workspace<rows>& space,
                        ModeMeasures<rows>& measures) const;

  MovingSystem system_;
  NominalMotion next_;
  Posture start_posture_;
  double start_phi_ = 0;
  std::vector<Link> links_;
  Index free_coordinates_ = 0;
  double coupling_ = 0;
  Eigen::VectorXd length_;  // factor by which coordinates are comparable: 1, or the model's size
  Eigen::VectorXd mu_;      // mass of the modes inside
  Eigen::MatrixXd K_, M_, shifted_;
  Eigen::MatrixXd P_;  // mass between free coordinates (rows) and modes inside
  DenseLdlt count_;
};

}  // namespace trammel::solver
