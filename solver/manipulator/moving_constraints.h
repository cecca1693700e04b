#pragma once

#include <Eigen/LU>
#include <vector>

#include "solver/linear/system.h"
#include "solver/manipulator/moving_element.h"
#include "solver/model/evidence.h"

namespace trammel::solver {

/// u = T q as the parts turn: C T = 0 with the pivots of the start, and its derivatives in time,
///   C_p X = - C_f,   C_p X. = - C. T,   C_p X.. = - C.. T - 2 C. T.,
/// X the eliminated coordinates (columns p of C) of the free ones (f).
class MovingConstraints {
 public:
  /// @param start  the system where it was built;  @param motion  of no part.
  /// @param derivatives  T. and T.. too.
  MovingConstraints(const System& start, const NominalMotion& motion, bool derivatives);

  /// singular: the coordinates that the constraints eliminate do not suit this pose; nothing
  /// changes.
  [[nodiscard]] Outcome move(const System& start, const NominalMotion& from,
                             const NominalMotion& to);

  /// Of the present pose; T has every entry that some pose needs.
  [[nodiscard]] const Constraints& constraints() const { return constraints_; }
  [[nodiscard]] const RowMajorMatrix& T() const { return constraints_.T; }
  /// On the pattern of T; empty where T is the same at every pose.
  [[nodiscard]] const RowMajorMatrix& T_dot() const { return T_dot_; }
  [[nodiscard]] const RowMajorMatrix& T_ddot() const { return T_ddot_; }
  [[nodiscard]] bool variable() const { return variable_; }  ///< T changes with the pose

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
  std::vector<std::size_t> dependent_rows_;  // rows of C beside supports ...
  std::vector<Index> dependent_row_of_;      // ... of each coordinate that they eliminate, or -1
  RowMajorMatrix select_free_, select_dependent_;  // u x q and u x row: ones where they are u
  Eigen::PartialPivLU<Eigen::MatrixXd> pivots_;
};

}  // namespace trammel::solver
