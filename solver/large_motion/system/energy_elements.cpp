#include "solver/large_motion/system/element_groups.h"

namespace trammel::large {

template class EnergyTerm<Triangle2d<3>>;
template class EnergyTerm<Triangle2d<6>>;
template class EnergyTerm<CoordinateSpring>;

}  // namespace trammel::large
