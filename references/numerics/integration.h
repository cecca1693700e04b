#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>

#include "references/numerics/real.h"

/// Integration of initial value problems in extended precision.
namespace trammel::references {

/// Integrates dx/dt = f(x, t) over an interval by Fehlberg's method of order 8 with equal steps.
/// @param rate  function rate(x, dxdt, t), which computes dx/dt
template <std::size_t n, class Rate>
void integrate(const Rate& rate, std::array<Real, n>& x, const Real& from, const Real& to,
               int steps) {
  using State = std::array<Real, n>;
  boost::numeric::odeint::runge_kutta_fehlberg78<State, Real, State, Real> stepper;
  const Real h = (to - from) / steps;
  for (int i = 0; i < steps; ++i) stepper.do_step(rate, x, Real(from + i * h), h);
}

}  // namespace trammel::references
