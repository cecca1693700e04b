#include "solver/large_motion/system/element_groups.h"

namespace trammel::large {

template class RowTerm<RigidLink>;
template class RowTerm<SlidingJoint>;
template class RowTerm<LineSpringElement>;
template class RowTerm<Bar>;
template class RowTerm<DrivenCoordinate>;

}  // namespace trammel::large
