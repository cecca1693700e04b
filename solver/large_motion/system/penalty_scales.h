#pragma once

#include <Eigen/Core>
#include <span>

#include "solver/large_motion/elements/large_motion_model.h"
#include "solver/large_motion/system/layout.h"
#include "solver/model/model.h"

namespace trammel::solver::large_motion {

/// Stiffness and mass of what a constraint row joins, from which its penalty rho follows (see
/// `KktMatrix`).
class PenaltyScales {
 public:
  /// @param mass  diagonal of the mass matrix, one entry a coordinate [kg or kg m^2]
  PenaltyScales(const Model& model, const LargeMotionModel& large_motion, const Layout& layout,
                Eigen::VectorXd mass);

  /// The largest stiffness among some coordinates; the model's mean where they have none [N/m].
  [[nodiscard]] double stiffness(std::span<const Index> coordinates) const;
  /// The largest mass among some coordinates; the model's mean where they have none [kg].
  [[nodiscard]] double mass(std::span<const Index> coordinates) const;

 private:
  Eigen::VectorXd stiffness_, mass_;  ///< of each coordinate
  double mean_stiffness_, mean_mass_;
};

}  // namespace trammel::solver::large_motion
