#pragma once

#include <Eigen/SparseCore>
#include <cmath>

#include "solver/model/effects.h"
#include "solver/motion/integrate.h"

/// Small numerical tools that the tests of the solver share.
namespace trammel::solver {

/// Returns d f / d s at 0 of a vector-valued function, by central differences that are extrapolated
/// twice: the error is of order h^6.
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

/// Returns the order of convergence from the errors at a step and at half this step.
inline double observed_order(double coarse, double fine) {
  return std::log2(coarse / fine);
}

inline TransientOptions transient_options(double end, double step,
                                          const TimeScheme& scheme = average_acceleration()) {
  TransientOptions options;
  options.end = end;
  options.step = step;
  options.scheme = scheme;
  return options;
}

inline SparseMatrix sparse(const Eigen::MatrixXd& A) {
  SparseMatrix S = A.sparseView();
  S.makeCompressed();
  return S;
}

}  // namespace trammel::solver
