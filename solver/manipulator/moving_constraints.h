#pragma once

#include <Eigen/LU>
#include <vector>

#include "solver/linear/system.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// Constraints u = T q of moving parts and the time derivatives of T. At every pose C T = 0, and
/// the eliminated coordinates are those of the start pose:
///
///   C_p X = - C_f,   C_p X. = - C. T,   C_p X.. = - C.. T - 2 C. T.
///
/// X expresses the eliminated coordinates (columns p of C) by the free ones (columns f).
class MovingConstraints {
 public:
  /// Finds the pattern of T.
  /// @param start  system at the pose at which it was built.
  /// @param motion  motion with no moving part.
  /// @param derivatives  true: also compute the time derivatives of T.
  MovingConstraints(const System& start, const NominalMotion& motion, bool derivatives);

  /// Computes T at a new motion. The outcome is singular if the coordinates that the constraints
  /// eliminate are unsuitable for this pose. T is then unchanged.
  [[nodiscard]] Outcome move(const System& start, const NominalMotion& from,
                             const NominalMotion& to);

  /// Returns the constraints at the current pose. T has all entries that any pose needs.
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] const RowMajorMatrix& T() const { return constraints_.T; }
  /// Returns T. on the pattern of T; empty if T is the same at every pose.
  [[nodiscard]] const RowMajorMatrix& T_dot() const { return T_dot_; }
  [[nodiscard]] const RowMajorMatrix& T_ddot() const { return T_ddot_; }
  [[nodiscard]] bool variable() const { return variable_; }  ///< true if T changes with the pose

 private:
  void find_dependent_rows();
  void extend_pattern(const System& start, const NominalMotion& motion);
  [[nodiscard]] Eigen::MatrixXd dependent_coordinates(const System& start,
                                                      const NominalMotion& motion);
  [[nodiscard]] Eigen::MatrixXd product(const System& start, const NominalMotion& motion, int order,
                                        const RowMajorMatrix& matrix) const;
  void store(const Eigen::MatrixXd& values, RowMajorMatrix& target) const;

  Constraints constraints_;
  bool derivatives_, variable_ = false;
  RowMajorMatrix T_dot_, T_ddot_;
  std::vector<std::size_t> dependent_rows_;  // rows of C except supports
  std::vector<Index> dependent_row_of_;      // for each coordinate that they eliminate, or -1
  // u x q and u x row, with ones at the selected coordinates.
  RowMajorMatrix select_free_, select_dependent_;
  Eigen::PartialPivLU<Eigen::MatrixXd> pivots_;
};

}  // namespace trammel::solver
