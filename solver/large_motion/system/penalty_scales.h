#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/large_motion/elements/large_motion_model.h"
#include "solver/large_motion/system/layout.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Of the parts that a constraint row joins, from which its penalty rho follows (see `KktMatrix`).
struct RowScales {
  double unit = 1;  ///< of the residual: 1 rad if all coordinates are rotations, otherwise the
                    ///< model's size [m]
  double stiffness = 0, mass = 0;  ///< the largest, in the unit of the row; the model's mean if the
                                   ///< coordinates have none
};

class PenaltyScales {
 public:
  /// @param mass  diagonal of the mass matrix, one entry a coordinate [kg or kg m^2]
  /// @param size  of the model [m]
  PenaltyScales(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                const Eigen::VectorXd& mass, double size);

  /// In a row of displacements rotations count, by their lever, if displacements have none.
  /// @param lever  of the row's rotations, if others are displacements [m]
  [[nodiscard]] RowScales of_row(std::span<const Index> coordinates, double lever) const;

 private:
  const Layout& layout_;
  double size_;                ///< of the model [m]
  Eigen::VectorXd stiffness_;  ///< of each coordinate [N/m or N m/rad]
  Eigen::VectorXd mass_;       ///< of each coordinate [kg or kg m^2]
  double mean_stiffness_, mean_mass_;
};

}  // namespace trammel::solver::large_motion
