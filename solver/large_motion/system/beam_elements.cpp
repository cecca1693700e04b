#include "solver/large_motion/system/element_groups.h"

namespace trammel::large {

template class RowTerm<Beam<1>>;
template class RowTerm<Beam<2>>;
template class RowTerm<Beam<3>>;

}  // namespace trammel::large
