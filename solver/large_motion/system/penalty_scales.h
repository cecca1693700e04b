#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "solver/large_motion/elements/large_motion_model.h"
#include "solver/large_motion/system/layout.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Stiffness and mass of the parts that a constraint row joins, from which its penalty rho follows
/// (see `KktMatrix`). In a row of displacements [m] rotations count, by their lever, if
/// displacements have none.
class PenaltyScales {
 public:
  /// @param mass  diagonal of the mass matrix, one entry a coordinate [kg or kg m^2]
  /// @param size  of the model [m]
  PenaltyScales(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                const Eigen::VectorXd& mass, double size);

  /// Largest stiffness among some coordinates, in the unit of their row: [N/m], or [N m/rad] if all
  /// are rotations. The model's mean if they have none.
  /// @param lever  of the row's rotations, if others are displacements [m]
  [[nodiscard]] double stiffness(std::span<const Index> coordinates, double lever) const;
  /// Largest mass among some coordinates, likewise [kg or kg m^2].
  [[nodiscard]] double mass(std::span<const Index> coordinates, double lever) const;
  /// Unit of the residual of a row that joins these coordinates: 1 rad if all are rotations,
  /// otherwise the model's size [m].
  [[nodiscard]] double row_unit(std::span<const Index> coordinates) const;

 private:
  [[nodiscard]] bool turns(std::span<const Index> coordinates) const;
  [[nodiscard]] double largest(const Eigen::VectorXd& values, double mean,
                               std::span<const Index> coordinates, double lever) const;

  const Layout& layout_;
  double size_;                ///< of the model [m]
  Eigen::VectorXd stiffness_;  ///< of each coordinate [N/m or N m/rad]
  Eigen::VectorXd mass_;       ///< of each coordinate [kg or kg m^2]
  double mean_stiffness_, mean_mass_;
};

}  // namespace trammel::solver::large_motion
