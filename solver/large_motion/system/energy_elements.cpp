#include "solver/large_motion/system/element_groups.h"

namespace trammel::large {

template class EnergyElements<Triangle2d<3>>;
template class EnergyElements<Triangle2d<6>>;
template class EnergyElements<CoordinateSpring>;

}  // namespace trammel::large
