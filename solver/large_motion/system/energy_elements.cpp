#include "solver/large_motion/system/element_groups.h"

namespace trammel::solver::large_motion {

template class EnergyElements<Triangle2d<3>>;
template class EnergyElements<Triangle2d<6>>;
template class EnergyElements<CoordinateSpring>;

}  // namespace trammel::solver::large_motion
