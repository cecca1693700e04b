#pragma once

#include "solver/large_motion/system/beam.h"
#include "solver/large_motion/system/element_group.h"
#include "solver/large_motion/system/joints.h"
#include "solver/large_motion/system/loads.h"
#include "solver/large_motion/system/triangle.h"

/// The kinds of element there are; each is compiled once.
namespace trammel::solver::large_motion {

extern template class ConstraintElements<Beam<1>>;
extern template class ConstraintElements<Beam<2>>;
extern template class ConstraintElements<Beam<3>>;
extern template class ConstraintElements<RigidLink>;
extern template class ConstraintElements<SlidingJoint>;
extern template class ConstraintElements<LineSpringElement>;
extern template class ConstraintElements<Bar>;
extern template class ConstraintElements<DrivenCoordinate>;
extern template class EnergyElements<Triangle2d<3>>;
extern template class EnergyElements<Triangle2d<6>>;
extern template class EnergyElements<CoordinateSpring>;

}  // namespace trammel::solver::large_motion
