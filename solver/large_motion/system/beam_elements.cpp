#include "solver/large_motion/system/element_groups.h"

namespace trammel::large {

template class ConstraintElements<Beam<1>>;
template class ConstraintElements<Beam<2>>;
template class ConstraintElements<Beam<3>>;

}  // namespace trammel::large
