#pragma once

#include <functional>

#include "references/frames/dynamic_stiffness.h"

/// Where a Wittrick-Williams count passes 1, 2, 3, ...: bracketed in double, the bracket confirmed
/// in extended precision, then refined there. None is missed or doubled, and a repeated one appears
/// as often as it occurs. (A double alone reaches about 3e-10.)
namespace trammel::references {

struct CountingFunction {
  std::function<int(double)> coarse;
  std::function<DynamicStiffness<Real>::Count(const Real&)> fine;
  double lo = 0;  ///< > 0; where the search begins; nothing sought lies below
  double hi = 0;  ///< where its doubling begins
};

/// The `index`-th passage (from 1), to 1e-20.
/// @throws DerivationError  where the count does not reach `index`.
[[nodiscard]] Real counted_root(const CountingFunction& f, int index);

/// The passages from `first` + 1 to `first` + `count`.
[[nodiscard]] std::vector<Real> counted_roots(const CountingFunction& f, int first, int count);

}  // namespace trammel::references
