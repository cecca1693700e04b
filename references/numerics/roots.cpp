#include "references/numerics/roots.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include <algorithm>
#include <boost/math/policies/policy.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>

#include "references/numerics/arguments.h"

namespace trammel::references {

namespace {

double evaluate(double x, void* f) {
  return (*static_cast<const std::function<double(double)>*>(f))(x);
}

/// Brent's method in double; f(lo) and f(hi) differ in sign.
double brent_root(const std::function<double(double)>& f, double lo, double hi) {
  const std::unique_ptr<gsl_root_fsolver, void (*)(gsl_root_fsolver*)> solver(
      gsl_root_fsolver_alloc(gsl_root_fsolver_brent), gsl_root_fsolver_free);
  gsl_set_error_handler_off();  // errors are returned, not aborts
  auto copy = f;
  gsl_function function{&evaluate, &copy};
  if (gsl_root_fsolver_set(solver.get(), &function, lo, hi) != GSL_SUCCESS) {
    throw DerivationError("no change of sign to bracket a root");
  }
  for (int i = 0; i < 200; ++i) {
    gsl_root_fsolver_iterate(solver.get());
    const double a = gsl_root_fsolver_x_lower(solver.get());
    const double b = gsl_root_fsolver_x_upper(solver.get());
    if (gsl_root_test_interval(a, b, 0, 1e-13) == GSL_SUCCESS) break;
  }
  return gsl_root_fsolver_root(solver.get());
}

/// A bracket around `x` in extended precision, widened until the sign changes but never beyond
/// [lo, hi].
std::pair<Real, Real> bracket(const std::function<Real(const Real&)>& f, double x, double lo,
                              double hi) {
  for (double width = 1e-12; width < 1; width *= 100) {
    const Real a = std::max(lo, x * (1 - width));
    const Real b = std::min(hi, x * (1 + width));
    if (f(a) * f(b) < 0) return {a, b};
  }
  return {Real(lo), Real(hi)};
}

}  // namespace

Real refined_root(const std::function<Real(const Real&)>& f, const Real& lo, const Real& hi) {
  const Real f_lo = f(lo);
  const Real f_hi = f(hi);
  if (f_lo == 0) return lo;
  if (f_hi == 0) return hi;
  if ((f_lo > 0) == (f_hi > 0)) throw DerivationError("no change of sign to bracket a root");
  std::uintmax_t iterations = 500;
  const auto close = [](const Real& a, const Real& b) {
    return abs(b - a) <= Real(1e-45) * (abs(a) + abs(b));
  };
  const auto ends = boost::math::tools::toms748_solve(f, lo, hi, f_lo, f_hi, close, iterations,
                                                      boost::math::policies::policy<>());
  return (ends.first + ends.second) / 2;
}

std::vector<Real> first_roots(const Equation& f, double start, double step, int count) {
  std::vector<Real> roots;
  double lo = start;
  double f_lo = f.coarse(lo);
  for (long i = 1; i <= 1000000 && static_cast<int>(roots.size()) < count; ++i) {
    const double hi = start + static_cast<double>(i) * step;
    const double f_hi = f.coarse(hi);
    if ((f_lo < 0) != (f_hi < 0)) {
      const auto [a, b] = bracket(f.fine, brent_root(f.coarse, lo, hi), lo, hi);
      roots.push_back(refined_root(f.fine, a, b));
    }
    lo = hi;
    f_lo = f_hi;
  }
  if (static_cast<int>(roots.size()) < count) throw DerivationError("too few roots were found");
  return roots;
}

std::vector<double> to_doubles(const std::vector<Real>& values) {
  std::vector<double> result;
  for (const Real& value : values) result.push_back(static_cast<double>(value));
  return result;
}

}  // namespace trammel::references
