#pragma once

#include <functional>
#include <vector>

#include "references/numerics/real.h"

/// Roots of characteristic equations: bracketed in double (GSL), polished in extended precision.
namespace trammel::references {

/// One equation in both precisions.
struct Equation {
  std::function<double(double)> coarse;
  std::function<Real(const Real&)> fine;
};

/// Both precisions from one generic callable.
template <class F>
[[nodiscard]] Equation equation(F f) {
  return {[f](double x) { return f(x); }, [f](const Real& x) { return f(x); }};
}

/// The root of `f` between lo and hi, where f changes sign, to 45 digits.
/// @throws DerivationError  where f does not change sign.
[[nodiscard]] Real refined_root(const std::function<Real(const Real&)>& f, const Real& lo,
                                const Real& hi);

/// The first `count` sign changes of `f` above `start`, found on a grid of spacing `step` and
/// polished. The caller answers for a step shorter than the distance between two roots.
/// @throws DerivationError  where fewer are found below start + 1e6 steps.
[[nodiscard]] std::vector<Real> first_roots(const Equation& f, double start, double step,
                                            int count);

/// Each value rounded to the nearest double.
[[nodiscard]] std::vector<double> to_doubles(const std::vector<Real>& values);

}  // namespace trammel::references
