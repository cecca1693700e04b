#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "solver/manipulator/moving_system.h"

namespace trammel::solver {

/// L D L^T, without exchanges, of a small symmetric matrix scaled to a unit diagonal; stored dense,
/// zeros skipped. Later calls of the same size do not allocate memory.
class DenseLdlt {
 public:
  /// Returns false if a pivot is zero or not finite; there is no factorization then.
  /// @param A  its lower triangle is read.
  [[nodiscard]] bool compute(const Eigen::MatrixXd& A);

  /// Of the scaled matrix: below 1, and for a positive definite one no less than its smallest
  /// eigenvalue.
  [[nodiscard]] double smallest_pivot() const { return pivots_.minCoeff(); }
  /// Sylvester: the number of negative eigenvalues.
  [[nodiscard]] Index negative_pivots() const { return (pivots_.array() < 0).count(); }
  /// Largest |L|: beyond about 1e8 the signs of the pivots mean nothing.
  [[nodiscard]] double element_growth() const { return growth_; }

  /// Right-hand sides side by side, one a row, so that a step is the same for all of them.
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
  /// @param model  at the pose, with the number of elements a link that are condensed; without.
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
  /// @param MX  X M.
  template <int rows>
  [[nodiscard]] ModeMeasures<rows> measure(const VectorBlock<rows>& X, const VectorBlock<rows>& MX,
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
  void measure_residual(const VectorBlock<rows>& X, const VectorBlock<rows>& MX,
                        Workspace<rows>& space, ModeMeasures<rows>& measures) const;

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
