#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/moving_system.h"

namespace trammel::solver {

/// LDL^T factorization without exchanges of a small symmetric matrix scaled to a unit diagonal. The
/// storage is dense, and zeros are skipped. Later calls with the same size do not allocate memory.
class DenseLdlt {
 public:
  /// Factors A. Returns false if a pivot is zero or not finite; then there is no factorization.
  /// @param A  its lower triangle is read.
  [[nodiscard]] bool compute(const Eigen::MatrixXd& A);

  /// Returns the smallest pivot of the scaled matrix. It is at most 1. For a positive definite
  /// matrix it is at least the smallest eigenvalue.
  [[nodiscard]] double smallest_pivot() const { return pivots_.minCoeff(); }
  /// Returns the number of negative eigenvalues (Sylvester).
  [[nodiscard]] Index negative_pivots() const { return (pivots_.array() < 0).count(); }
  /// Returns the largest |L|. The signs of the pivots are unreliable if it exceeds about 1e8.
  [[nodiscard]] double element_growth() const { return growth_; }

  /// Solves for several right-hand sides, one per row of X. Each operation is applied to all rows.
  template <class Block>
  void solve_in_place(Block& X) const {
    const Index n = L_.rows();
    for (Index i = 0; i < n; ++i) X.col(i) *= scale_[i];
    for (Index k = 0; k < n; ++k) {
      for (Index i = k + 1; i < n; ++i) {
        if (L_(i, k) != 0) X.col(i) -= L_(i, k) * X.col(k);
      }
    }
    for (Index k = n - 1; k >= 0; --k) {
      X.col(k) /= pivots_[k];
      for (Index i = k + 1; i < n; ++i) {
        if (L_(i, k) != 0) X.col(k) -= L_(i, k) * X.col(i);
      }
    }
    for (Index i = 0; i < n; ++i) X.col(i) *= scale_[i];
  }

 private:
  Eigen::MatrixXd L_;
  Eigen::VectorXd pivots_, scale_;
  double growth_ = 0;
};

/// Several vectors in the coordinates of a MovingPencil: row x coordinate. Each operation is
/// applied to all rows. The number of rows is known at compile time.
template <int rows>
struct VectorBlock {
  Eigen::Matrix<double, rows, Eigen::Dynamic> ends;  ///< free coordinates of the joints
  /// Modes of the link interiors, link by link.
  Eigen::Matrix<double, rows, Eigen::Dynamic> inside;
};

/// Temporary blocks, kept to avoid memory allocation in each step.
template <int rows>
struct Workspace {
  Eigen::Matrix<double, rows, Eigen::Dynamic> U, sizes;
};

/// Energies and residuals of approximate modes, one number per row.
template <int rows>
struct ModeMeasures {
  using Numbers = Eigen::Array<double, rows, 1>;
  Numbers strain;    ///< x^T K x from the deformations [J]
  Numbers rounding;  ///< 2 eps sum |d|^T c |B| |u|, the effect of rounding x on the strain
  Numbers inertia;   ///< x^T M x [J s^2]
  /// Largest ratio of a row of (K - strain / inertia M) x to the magnitudes of its terms.
  Numbers backward_error;
};

/// K and M of a manipulator with condensed links as functions of its pose. The coordinates are
/// those of the joints (one or two dozen) and the modes of the link interiors. These modes have
/// stiffness 1, and only inertia couples them.
class MovingPencil {
 public:
  /// Builds the matrices.
  /// @param model  model at the pose, without inactive effects; its number of elements per link
  ///   defines the condensation.
  /// @param geometry  dimensions.
  /// @param pose  pose of the model.
  MovingPencil(const Model& model, const ManipulatorGeometry& geometry, const Pose& pose);

  /// Moves to a pose. The outcome is singular if the coordinates that the constraints eliminate are
  /// unsuitable for this pose.
  [[nodiscard]] Outcome move_to(const Posture& posture, const Pose& pose);

  [[nodiscard]] Index ends() const { return K_.rows(); }
  [[nodiscard]] Index inside() const { return mu_.size(); }
  /// Returns the number of free coordinates without condensation, including massless interior ones.
  [[nodiscard]] Index free_coordinates() const { return free_coordinates_; }
  [[nodiscard]] const Counters& counters() const { return system_.start().counters; }
  [[nodiscard]] double coupling() const { return coupling_; }  ///< largest coupling of the links

  /// Returns the stiffness of the joint coordinates at the current pose.
  [[nodiscard]] const Eigen::MatrixXd& K() const { return K_; }
  /// Returns the number of eigenvalues of the full model below `shift`, from the signs of the
  /// pivots of K - shift M. It is the sum of the counts of the interior and of its Schur complement
  /// on the joint coordinates (Wittrick & Williams 1971). The result is -1 if the pivots are
  /// dominated by round-off.
  [[nodiscard]] Index eigenvalues_below(double shift);

  /// Computes Y = X M.
  template <int rows>
  void mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y) const;
  /// Computes energies and residuals of approximate modes.
  /// @param X  approximate modes.
  /// @param MX  X M.
  /// @param space  temporary blocks.
  template <int rows>
  [[nodiscard]] ModeMeasures<rows> measure_modes(const VectorBlock<rows>& X,
                                                 const VectorBlock<rows>& MX,
                                                 Workspace<rows>& space) const;

 private:
  struct Link {
    Index first = 0, last = 0;  ///< range of its modes in VectorBlock::inside
    std::vector<Index> ends;    ///< free coordinates that move its ends
  };

  template <int rows>
  void measure_strain(const VectorBlock<rows>& X,
                      const Eigen::Matrix<double, rows, Eigen::Dynamic>& U,
                      ModeMeasures<rows>& measures) const;
  template <int rows>
  void measure_residual(const VectorBlock<rows>& X, const VectorBlock<rows>& MX,
                        Workspace<rows>& space, ModeMeasures<rows>& measures) const;

  MovingSystem system_;
  NominalMotion next_;
  Posture start_posture_;
  double start_phi_ = 0;
  std::vector<Link> links_;
  Index free_coordinates_ = 0;
  double coupling_ = 0;
  Eigen::VectorXd length_;  // scale of each coordinate: 1, or the model size for rotations
  Eigen::VectorXd mu_;      // mass of the interior modes
  Eigen::MatrixXd K_, M_, shifted_;
  Eigen::MatrixXd P_;  // mass between free coordinates (rows) and interior modes
  DenseLdlt count_;
};

}  // namespace trammel::solver
