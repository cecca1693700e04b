#pragma once

#include "solver/manipulator/frequency_sensitivity.h"

/// Values of the parameters of a design, and changed designs.
namespace trammel::harness {

struct DesignInPose {
  solver::ManipulatorDesign design;
  solver::Pose pose;
};

/// The design with the parameter increased by `change` [unit of the parameter: m, Pa, kg/m^3, -,
/// kg, kg m^2, N m/rad, rad].
[[nodiscard]] DesignInPose perturbed(const solver::ManipulatorDesign& design,
                                     const solver::Pose& pose,
                                     const solver::DesignParameter& parameter, double change);

/// The parameter's value [its unit]: the largest of the numbers that it names; 0 where the design
/// has none. Of the orientation 1 rad, for no angle counts as none.
[[nodiscard]] double parameter_value(const solver::ManipulatorDesign& design,
                                     const solver::DesignParameter& parameter);

}  // namespace trammel::harness
