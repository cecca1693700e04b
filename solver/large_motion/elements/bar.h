#pragma once

#include "solver/large_motion/elements/joints.h"

namespace trammel::solver::large_motion {

/// Member without bending stiffness: a line spring of 1/k = h/EA with its mass, linear between the
/// ends.
struct Bar : LineSpringElement {
  double total_mass = 0;  ///< [kg]
  bool lumped = false;

  [[nodiscard]] Square mass() const {
    const double diagonal = total_mass / (lumped ? 2 : 3),
                 off_diagonal = lumped ? 0 : total_mass / 6;
    const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
    return (Square() << diagonal * I, off_diagonal * I, off_diagonal * I, diagonal * I).finished();
  }
};

}  // namespace trammel::solver::large_motion
