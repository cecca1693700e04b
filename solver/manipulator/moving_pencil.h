#pragma once

#include <Eigen/Core>
#include <vector>

#include "solver/manipulator/moving_system.h"

namespace trammel::solver {

/// LDL^T factorization of a small symmetric matrix without row exchanges. The matrix is scaled to a
/// unit diagonal. The storage is dense, and multiplications by zero are skipped. Repeated
/// factorizations of matrices of the same size do not allocate memory.
class DenseLdlt {
 public:
  /// Factorizes A, of which only the lower triangle is read. Returns false if a pivot is zero or
  /// not finite; the factorization is then invalid.
  [[nodiscard]] bool compute(const Eigen::MatrixXd& A);

  /// Returns the smallest pivot of the scaled matrix, which is at most 1. For a positive definite
  /// matrix, the smallest pivot is at least the smallest eigenvalue.
  [[nodiscard]] double smallest_pivot() const { return pivots_.minCoeff(); }
  /// Returns the number of negative pivots, which equals the number of negative eigenvalues of A
  /// (Sylvester's law of inertia).
  [[nodiscard]] Index negative_pivots() const { return (pivots_.array() < 0).count(); }
  /// Returns the largest magnitude of an entry of the factor L. If this magnitude exceeds 1e8, the
  /// signs of the pivots are unreliable.
  [[nodiscard]] double element_growth() const { return growth_; }

  /// Solves A x = b for several right-hand sides b, one per row of X.
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

/// Several vectors in the coordinates of a MovingPencil, one vector per row. The number of rows is
/// known at compile time, so that each operation processes all vectors at once.
template <int rows>
struct VectorBlock {
  /// Components of the free joint coordinates.
  Eigen::Matrix<double, rows, Eigen::Dynamic> ends;
  /// Amplitudes of the modes of the link interiors, link by link.
  Eigen::Matrix<double, rows, Eigen::Dynamic> inside;
};

/// Temporary matrices that are reused in each step of an iteration to avoid memory allocation.
template <int rows>
struct Workspace {
  Eigen::Matrix<double, rows, Eigen::Dynamic> U, sizes;
};

/// Energies and residuals of approximate modes x, one number per mode.
template <int rows>
struct ModeMeasures {
  using Numbers = Eigen::Array<double, rows, 1>;
  Numbers strain;    ///< x^T K x from the deformations [J]
  Numbers rounding;  ///< effect of round-off errors of x on `strain` [J]
  Numbers inertia;   ///< x^T M x [J s^2]
  /// Largest ratio of a row of K x - w^2 M x to the magnitudes of its terms, with the Rayleigh
  /// quotient w^2 = strain / inertia.
  Numbers backward_error;
};

/// Stiffness matrix K and mass matrix M of a manipulator with condensed links as functions of its
/// pose. The coordinates are usually one or two dozen joint coordinates and the amplitudes of the
/// modes of the link interiors. Each interior mode has stiffness 1, and only M couples interior
/// modes and joint coordinates.
class MovingPencil {
 public:
  /// Builds K and M from a model at the pose `pose`. The model must not contain inactive effects.
  /// The number of interior modes of a link follows from its number of elements.
  MovingPencil(const Model& model, const ManipulatorGeometry& geometry, const Pose& pose);

  /// Computes the stiffness matrix K and the mass matrix M at a pose. The outcome is singular if
  /// the constraints do not determine the eliminated coordinates at this pose.
  [[nodiscard]] Outcome move_to(const Posture& posture, const Pose& pose);

  [[nodiscard]] Index joint_coordinate_count() const { return K_.rows(); }
  [[nodiscard]] Index interior_mode_count() const { return mu_.size(); }
  /// Returns the number of free coordinates of the model without condensation, including massless
  /// interior coordinates.
  [[nodiscard]] Index free_coordinate_count() const { return free_coordinates_; }
  [[nodiscard]] const Counters& counters() const { return system_.start().counters; }
  /// Returns the largest neglected coupling of interior modes within a link (LinkSuperelement).
  [[nodiscard]] double largest_coupling() const { return coupling_; }

  /// Returns the stiffness matrix of the joint coordinates at the current pose.
  [[nodiscard]] const Eigen::MatrixXd& K() const { return K_; }
  /// Returns the number of eigenvalues of the full model below `shift`, from the signs of the
  /// pivots of K - shift M. This number is the sum of the negative pivots of the link interiors and
  /// of their Schur complement on the joint coordinates (Wittrick & Williams 1971). The result is
  /// -1 if the pivots are dominated by round-off errors.
  [[nodiscard]] Index eigenvalues_below(double shift);

  /// Computes the products Y = X M of the vectors in the rows of X with the mass matrix M.
  template <int rows>
  void mass_times(const VectorBlock<rows>& X, VectorBlock<rows>& Y) const;
  /// Computes energies and residuals of approximate modes X from X and from the product MX = X M.
  template <int rows>
  [[nodiscard]] ModeMeasures<rows> measure_modes(const VectorBlock<rows>& X,
                                                 const VectorBlock<rows>& MX,
                                                 Workspace<rows>& space) const;

 private:
  struct Link {
    Index first = 0, last = 0;  ///< range of the modes of the link in VectorBlock::inside
    /// Free joint coordinates that move the ends of the link.
    std::vector<Index> ends;
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
  // Length by which each coordinate is multiplied: 1, or the model size for rotations.
  Eigen::VectorXd length_;
  // Modal masses 1 / omega^2 of the interior modes, which have stiffness 1.
  Eigen::VectorXd mu_;
  Eigen::MatrixXd K_, M_, shifted_;
  Eigen::MatrixXd P_;  // mass coupling of joint coordinates (rows) and interior modes
  DenseLdlt count_;
};

}  // namespace trammel::solver
