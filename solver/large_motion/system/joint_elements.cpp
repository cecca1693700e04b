#include "solver/large_motion/system/element_groups.h"

namespace trammel::solver::large_motion {

template class ConstraintElements<RigidLink>;
template class ConstraintElements<SlidingJoint>;
template class ConstraintElements<LineSpringElement>;
template class ConstraintElements<Bar>;
template class ConstraintElements<DrivenCoordinate>;

}  // namespace trammel::solver::large_motion
