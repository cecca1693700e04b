#pragma once

namespace trammel::solver {

/// d f / d s at 0 of a function that returns a vector, by central differences extrapolated twice:
/// error of the order h^6.
template <class F>
auto richardson(const F& f, double h) {
  const auto central = [&](double s) { return ((f(s) - f(-s)) / (2 * s)).eval(); };
  const auto d1 = central(h);
  const auto d2 = central(h / 2);
  const auto d4 = central(h / 4);
  const auto e1 = ((4 * d2 - d1) / 3).eval();
  const auto e2 = ((4 * d4 - d2) / 3).eval();
  return ((16 * e2 - e1) / 15).eval();
}

}  // namespace trammel::solver
