#include "references/data/manufactured.h"

#include <boost/math/differentiation/autodiff.hpp>

namespace trammel::references::manufactured {
namespace {

constexpr double kPi = 3.141592653589793238462643383279503;

using boost::math::differentiation::autodiff_fvar;
using boost::math::differentiation::make_fvar;

/// Function of x and y with its first and second derivatives.
using Field = autodiff_fvar<double, 2, 2>;

/// Function of x with its first four derivatives.
using Shape = autodiff_fvar<double, 4>;

/// Displacements u and v of a membrane at a point [m].
std::array<Field, 2> displacement(const MembraneProblem& problem, double at_x, double at_y) {
  const double a = problem.amplitude;
  const Field x = make_fvar<double, 2>(at_x) / problem.length;
  const Field y = make_fvar<double, 0, 2>(at_y) / problem.height;
  switch (problem.field) {
    case MembraneField::clamped:
      return {a * sin(kPi * x) * sin(kPi * y), a * sin(2 * kPi * x) * sin(kPi * y)};
    case MembraneField::cantilever:
      return {a * sin(kPi / 2 * x) * cos(kPi / 2 * y), a * (1 - cos(kPi / 2 * x)) * exp(0.5 * y)};
    case MembraneField::uniform_strain:
      return {a * x, a * (0.7 * x - 0.4 * y)};
    case MembraneField::linear_strain:
      break;
  }
  return {a * (x + 0.6 * x * x - 0.8 * x * y),
          a * (0.7 * x - 0.4 * y + 0.5 * x * x + 0.3 * x * y - 0.9 * y * y)};
}

/// Bending shape of a beam [m]. It vanishes together with its first derivative at x = 0.
Shape bending_shape(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  if (problem.field == BeamField::cubic) return problem.amplitude * xi * xi * (1 - 0.4 * xi);
  return problem.amplitude * (exp(xi) - 1 - xi + (1 - cos(3 * xi)) / 4);
}

/// Axial shape of a beam [m]. It vanishes at x = 0.
Shape axial_shape(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  return problem.amplitude / 2 * (problem.field == BeamField::cubic ? xi : Shape(sin(2 * xi)));
}

/// Independent shear angle of a beam [rad]. It vanishes at x = 0.
Shape shear_angle(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  return problem.amplitude / (2 * problem.length) * sin(2 * xi);
}

}  // namespace

MembraneState evaluate(const MembraneProblem& problem, double x, double y) {
  const auto [u, v] = displacement(problem, x, y);
  const double ux = u.derivative(1, 0), uy = u.derivative(0, 1);
  const double vx = v.derivative(1, 0), vy = v.derivative(0, 1);
  const double uxy = u.derivative(1, 1), vxy = v.derivative(1, 1);
  const double nu = problem.nu;
  const double D = problem.E / (1 - nu * nu);
  const double G = problem.E / (2 * (1 + nu));
  const double inertia = problem.rho * problem.omega * problem.omega;
  MembraneState s;
  s.displacement = {u.derivative(0, 0), v.derivative(0, 0)};
  s.rotation = 0.5 * (vx - uy);
  s.strain = {ux, vy, uy + vx};
  s.stress = {D * (ux + nu * vy), D * (vy + nu * ux), G * (uy + vx)};
  s.body_force = {-D * (u.derivative(2, 0) + nu * vxy) - G * (u.derivative(0, 2) + vxy) -
                      inertia * s.displacement[0],
                  -D * (v.derivative(0, 2) + nu * uxy) - G * (uxy + v.derivative(2, 0)) -
                      inertia * s.displacement[1]};
  return s;
}

std::array<bool, 2> fixed_displacements(const MembraneProblem& problem, double x, double y) {
  const double tolerance = 1e-9;
  const bool left = x < tolerance * problem.length;
  const bool bottom = y < tolerance * problem.height;
  const bool right = x > (1 - tolerance) * problem.length;
  const bool top = y > (1 - tolerance) * problem.height;
  const bool is_on_edge = left || right || bottom || top;
  if (problem.field == MembraneField::clamped) return {is_on_edge, is_on_edge};
  return {left, left && (bottom || problem.field == MembraneField::cantilever)};
}

BeamState evaluate(const BeamProblem& problem, double x) {
  const Shape u = axial_shape(problem, x);
  const Shape w = bending_shape(problem, x);
  const double square = problem.omega * problem.omega;
  const double EI = problem.EI;
  BeamState s;
  s.axial = u.derivative(0);
  s.axial_force = problem.EA * u.derivative(1);
  s.axial_load = -problem.EA * u.derivative(2) - problem.mass_per_length * square * u.derivative(0);
  if (problem.shear == ShearStrain::independent) {
    const Shape g = shear_angle(problem, x);
    s.deflection = w.derivative(0);
    s.rotation = w.derivative(1) - g.derivative(0);
    s.bending_moment = EI * (w.derivative(2) - g.derivative(1));
    s.shear_force = problem.kappa_GA * g.derivative(0);
    s.transverse_load = -problem.kappa_GA * g.derivative(1);
    s.moment_load = -EI * (w.derivative(3) - g.derivative(2)) - s.shear_force;
  } else {
    const bool rigid = problem.shear == ShearStrain::none;
    const double clamped = bending_shape(problem, 0).derivative(2);
    s.deflection = rigid ? w.derivative(0)
                         : w.derivative(0) - EI / problem.kappa_GA * (w.derivative(2) - clamped);
    s.rotation = w.derivative(1);
    s.bending_moment = EI * w.derivative(2);
    s.shear_force = -EI * w.derivative(3);
    s.transverse_load = EI * w.derivative(4);
    s.moment_load = 0;
  }
  s.transverse_load -= problem.mass_per_length * square * s.deflection;
  if (problem.shear != ShearStrain::none) {
    s.moment_load -= problem.inertia_per_length * square * s.rotation;
  }
  return s;
}

}  // namespace trammel::references::manufactured
