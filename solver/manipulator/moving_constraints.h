#pragma once

#include <Eigen/LU>
#include <vector>

#include "solver/linear/system.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Constraints C u = 0 of a moving manipulator, expressed as u = T q with free coordinates q, and
/// the time derivatives of T. C T = 0 at every pose. The same coordinates are eliminated at every
/// pose. A dot denotes the time derivative:
///
///   C_p X = - C_f,   C_p X. = - C. T,   C_p X.. = - C.. T - 2 C. T.
///
/// X is the part of T that expresses eliminated coordinates (columns p of C) by free coordinates
/// (columns f of C).
class MovingConstraints {
 public:
  /// Finds the sparsity pattern of the matrix T in u = T q. `start` is the system at the pose at
  /// which it was built, and `motion` the nominal motion at this pose. Time derivatives of T are
  /// computed if `derivatives` is true.
  MovingConstraints(const System& start, const NominalMotion& motion, bool derivatives);

  /// Computes the matrix T in u = T q for the nominal motion `to`. `from` is the nominal motion for
  /// which T was computed last. T is unchanged if all members and bodies have equal motions in
  /// `from` and `to`. The outcome is singular if the constraints do not determine the eliminated
  /// coordinates at the pose of `to`. T is then also unchanged. `start` is the system at the pose
  /// at which it was built.
  [[nodiscard]] Outcome update_transformation(const System& start, const NominalMotion& from,
                                              const NominalMotion& to);

  /// Returns the constraints at the current pose. The sparsity pattern of T includes all entries
  /// that are nonzero at any pose.
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] const RowMajorMatrix& T() const { return constraints_.T; }
  /// Returns the first (T_dot) or second (T_ddot) time derivative of the matrix T in u = T q. The
  /// derivative is empty if T is the same at every pose.
  [[nodiscard]] const RowMajorMatrix& T_dot() const { return T_dot_; }
  [[nodiscard]] const RowMajorMatrix& T_ddot() const { return T_ddot_; }
  [[nodiscard]] bool is_pose_dependent() const {
    return variable_;
  }  ///< true if T changes with the pose

 private:
  void find_eliminating_rows();
  void extend_pattern(const System& start, const NominalMotion& motion);
  [[nodiscard]] Eigen::MatrixXd dependent_coordinate_matrix(const System& start,
                                                            const NominalMotion& motion);
  [[nodiscard]] Eigen::MatrixXd derivative_times(const System& start, const NominalMotion& motion,
                                                 int order, const RowMajorMatrix& matrix) const;
  void store_dependent_rows(const Eigen::MatrixXd& values, RowMajorMatrix& target) const;

  Constraints constraints_;
  bool derivatives_, variable_ = false;
  RowMajorMatrix T_dot_, T_ddot_;
  // Indices of the rows of the constraint matrix C that eliminate a coordinate, except rows of
  // supports.
  std::vector<std::size_t> dependent_rows_;
  // Index in dependent_rows_ for each coordinate u, or -1 for coordinates without such a row.
  std::vector<Index> dependent_row_of_;
  // Matrices of zeros and ones that select the free coordinates (u x q) and the eliminated
  // coordinates (u x row) from all coordinates u.
  RowMajorMatrix select_free_, select_dependent_;
  Eigen::PartialPivLU<Eigen::MatrixXd> pivots_;
};

}  // namespace trammel::solver
