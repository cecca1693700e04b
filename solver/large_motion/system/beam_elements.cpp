#include "solver/large_motion/system/element_groups.h"

namespace trammel::solver::large_motion {

template class ConstraintElements<Beam<1>>;
template class ConstraintElements<Beam<2>>;
template class ConstraintElements<Beam<3>>;

}  // namespace trammel::solver::large_motion
