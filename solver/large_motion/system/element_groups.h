#pragma once

#include "solver/large_motion/system/beam.h"
#include "solver/large_motion/system/joints.h"
#include "solver/large_motion/system/loads.h"
#include "solver/large_motion/system/element_group.h"
#include "solver/large_motion/system/triangle.h"

/// The kinds of element there are; each is compiled once.
namespace trammel::large {

extern template class RowTerm<Beam<1>>;
extern template class RowTerm<Beam<2>>;
extern template class RowTerm<Beam<3>>;
extern template class RowTerm<RigidLink>;
extern template class RowTerm<SlidingJoint>;
extern template class RowTerm<LineSpringElement>;
extern template class RowTerm<Bar>;
extern template class RowTerm<DrivenCoordinate>;
extern template class EnergyTerm<Triangle2d<3>>;
extern template class EnergyTerm<Triangle2d<6>>;
extern template class EnergyTerm<CoordinateSpring>;

}  // namespace trammel::large
