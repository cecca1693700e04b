#include <boost/math/policies/policy.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

#include "references/numerics/arguments.h"
#include "references/numerics/real.h"

namespace trammel::references {

Real refined_root(const std::function<Real(const Real&)>& f, const Real& lo, const Real& hi) {
  const Real f_lo = f(lo), f_hi = f(hi);
  if (f_lo == 0) return lo;
  if (f_hi == 0) return hi;
  if ((f_lo > 0) == (f_hi > 0))
    throw DerivationError("a function does not change sign in the interval of its root");
  std::uintmax_t iterations = 500;
  const auto close = [](const Real& a, const Real& b) {
    return abs(b - a) <= Real(1e-45) * (abs(a) + abs(b));
  };
  const auto ends = boost::math::tools::toms748_solve(f, lo, hi, f_lo, f_hi, close, iterations,
                                                      boost::math::policies::policy<>());
  return (ends.first + ends.second) / 2;
}

std::vector<Real> first_roots(const std::function<Real(const Real&)>& f, const Real& start,
                              const Real& spacing, int count) {
  std::vector<Real> roots;
  Real lo = start, f_lo = f(lo);
  for (int i = 1; i <= 100000 && static_cast<int>(roots.size()) < count; ++i) {
    const Real hi = start + i * spacing, f_hi = f(hi);
    if ((f_lo < 0) != (f_hi < 0)) roots.push_back(refined_root(f, lo, hi));
    lo = hi;
    f_lo = f_hi;
  }
  if (static_cast<int>(roots.size()) < count)
    throw DerivationError("the characteristic function has fewer roots than requested");
  return roots;
}

}  // namespace trammel::references
