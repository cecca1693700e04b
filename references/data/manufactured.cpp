#include "references/data/manufactured.h"

#include <cmath>
#include <complex>

namespace trammel::references::manufactured {
namespace {

constexpr double kPi = 3.141592653589793238462643383279503;

/// A function of one variable with its first derivatives.
template <typename T>
using Jet = std::array<T, 5>;

template <typename T>
Jet<T> sine(double k, const T& x) {
  using std::cos;
  using std::sin;
  const T s = sin(k * x);
  const T c = cos(k * x);
  return {s, k * c, -k * k * s, -k * k * k * c, k * k * k * k * s};
}

template <typename T>
Jet<T> one_minus_cosine(double k, const T& x) {
  using std::cos;
  using std::sin;
  const T s = sin(k * x);
  const T c = cos(k * x);
  return {1.0 - c, k * s, k * k * c, -k * k * k * s, -k * k * k * k * c};
}

template <typename T>
Jet<T> cosine(double k, const T& x) {
  Jet<T> jet = one_minus_cosine(k, x);
  for (T& d : jet) d = -d;
  jet[0] += 1.0;
  return jet;
}

template <typename T>
Jet<T> exponential(double k, const T& x) {
  using std::exp;
  const T e = exp(k * x);
  return {e, k * e, k * k * e, k * k * k * e, k * k * k * k * e};
}

/// a x + b x^2 + c x^3
template <typename T>
Jet<T> cubic(double a, double b, double c, const T& x) {
  return {x * (a + x * (b + x * c)), a + x * (2 * b + x * (3 * c)), 2 * b + 6 * c * x, T(6 * c),
          T(0)};
}

template <typename T>
Jet<T> sum(const Jet<T>& a, double weight, const Jet<T>& b) {
  Jet<T> jet = a;
  for (std::size_t i = 0; i < jet.size(); ++i) jet[i] += weight * b[i];
  return jet;
}

/// From derivatives with respect to x / length to derivatives with respect to x, times `factor`.
template <typename T>
Jet<T> rescaled(Jet<T> jet, double factor, double length) {
  for (T& d : jet) {
    d *= factor;
    factor /= length;
  }
  return jet;
}

/// A function of two variables with its first and second derivatives.
template <typename T>
struct Jet2d {
  T f{}, x{}, y{}, xx{}, xy{}, yy{};
};

template <typename T>
Jet2d<T> product(const Jet<T>& a, const Jet<T>& b) {
  return {a[0] * b[0], a[1] * b[0], a[0] * b[1], a[2] * b[0], a[1] * b[1], a[0] * b[2]};
}

/// Scales the dimensionless coordinates x / length, y / height and the values.
template <typename T>
Jet2d<T> scaled(const Jet2d<T>& p, const MembraneProblem& problem) {
  const double a = problem.amplitude;
  const double l = problem.length;
  const double h = problem.height;
  return {a * p.f,           a / l * p.x, a / h * p.y, a / (l * l) * p.xx, a / (l * h) * p.xy,
          a / (h * h) * p.yy};
}

template <typename T>
std::array<Jet2d<T>, 2> displacement(MembraneField field, const T& x, const T& y) {
  switch (field) {
    case MembraneField::clamped:
      return {product(sine(kPi, x), sine(kPi, y)), product(sine(2 * kPi, x), sine(kPi, y))};
    case MembraneField::cantilever:
      return {product(sine(kPi / 2, x), cosine(kPi / 2, y)),
              product(one_minus_cosine(kPi / 2, x), exponential(0.5, y))};
    case MembraneField::uniform_strain:
      return {Jet2d<T>{x, T(1)}, Jet2d<T>{0.7 * x - 0.4 * y, T(0.7), T(-0.4)}};
    case MembraneField::linear_strain:
      break;
  }
  const auto quadratic = [&](double a, double b, double c, double d, double e) {
    return Jet2d<T>{a * x + b * y + c * x * x + d * x * y + e * y * y,
                    a + 2 * c * x + d * y,
                    b + d * x + 2 * e * y,
                    T(2 * c),
                    T(d),
                    T(2 * e)};
  };
  return {quadratic(1, 0, 0.6, -0.8, 0), quadratic(0.7, -0.4, 0.5, 0.3, -0.9)};
}

/// Vanishes with its first derivative at x = 0.
template <typename T>
Jet<T> bending_shape(const BeamProblem& problem, const T& x) {
  const T xi = x / problem.length;
  Jet<T> shape = cubic(0, 1, -0.4, xi);
  if (problem.field == BeamField::smooth) {  // e^xi - 1 - xi + (1 - cos 3 xi) / 4
    shape = sum(exponential(1, xi), 0.25, one_minus_cosine(3, xi));
    shape[0] -= 1.0 + xi;
    shape[1] -= 1.0;
  }
  return rescaled(shape, problem.amplitude, problem.length);
}

/// Vanishes at x = 0.
template <typename T>
Jet<T> axial_shape(const BeamProblem& problem, const T& x) {
  const T xi = x / problem.length;
  const Jet<T> shape = problem.field == BeamField::cubic ? cubic(1, 0, 0, xi) : sine(2, xi);
  return rescaled(shape, problem.amplitude / 2, problem.length);
}

/// Vanishes at x = 0.
template <typename T>
Jet<T> shear_angle(const BeamProblem& problem, const T& x) {
  const double l = problem.length;
  return rescaled(sine(2, T(x / l)), problem.amplitude / (2 * l), l);
}

}  // namespace

template <typename T>
MembraneState<T> evaluate(const MembraneProblem& problem, const T& x, const T& y) {
  const auto uv = displacement<T>(problem.field, x / problem.length, y / problem.height);
  const Jet2d<T> u = scaled(uv[0], problem);
  const Jet2d<T> v = scaled(uv[1], problem);
  const double nu = problem.nu;
  const double D = problem.E / (1 - nu * nu);
  const double G = problem.E / (2 * (1 + nu));
  const double inertia = problem.rho * problem.omega * problem.omega;
  MembraneState<T> s;
  s.displacement = {u.f, v.f};
  s.rotation = 0.5 * (v.x - u.y);
  s.strain = {u.x, v.y, u.y + v.x};
  s.stress = {D * (u.x + nu * v.y), D * (v.y + nu * u.x), G * (u.y + v.x)};
  s.body_force = {-D * (u.xx + nu * v.xy) - G * (u.yy + v.xy) - inertia * u.f,
                  -D * (v.yy + nu * u.xy) - G * (u.xy + v.xx) - inertia * v.f};
  return s;
}

std::array<bool, 2> fixed_displacements(const MembraneProblem& problem, double x, double y) {
  const double tolerance = 1e-9;
  const bool left = x < tolerance * problem.length;
  const bool bottom = y < tolerance * problem.height;
  const bool right = x > (1 - tolerance) * problem.length;
  const bool top = y > (1 - tolerance) * problem.height;
  switch (problem.field) {
    case MembraneField::clamped: {
      const bool edge = left || right || bottom || top;
      return {edge, edge};
    }
    case MembraneField::cantilever:
      return {left, left};
    case MembraneField::uniform_strain:
    case MembraneField::linear_strain:
      break;
  }
  return {left, left && bottom};
}

template <typename T>
BeamState<T> evaluate(const BeamProblem& problem, const T& x) {
  const Jet<T> u = axial_shape(problem, x);
  const Jet<T> w = bending_shape(problem, x);
  const double square = problem.omega * problem.omega;
  const double EI = problem.EI;
  BeamState<T> s;
  s.axial = u[0];
  s.axial_force = problem.EA * u[1];
  s.axial_load = -problem.EA * u[2] - problem.mass_per_length * square * u[0];
  if (problem.shear == ShearStrain::independent) {
    const Jet<T> g = shear_angle(problem, x);
    s.deflection = w[0];
    s.rotation = w[1] - g[0];
    s.bending_moment = EI * (w[2] - g[1]);
    s.shear_force = problem.kappa_GA * g[0];
    s.transverse_load = -problem.kappa_GA * g[1];
    s.moment_load = -EI * (w[3] - g[2]) - s.shear_force;
  } else {
    const bool rigid = problem.shear == ShearStrain::none;
    const T clamped = bending_shape(problem, T(0))[2];
    s.deflection = rigid ? w[0] : w[0] - EI / problem.kappa_GA * (w[2] - clamped);
    s.rotation = w[1];
    s.bending_moment = EI * w[2];
    s.shear_force = -EI * w[3];
    s.transverse_load = EI * w[4];
    s.moment_load = T(0);
  }
  s.transverse_load -= problem.mass_per_length * square * s.deflection;
  if (problem.shear != ShearStrain::none) {
    s.moment_load -= problem.inertia_per_length * square * s.rotation;
  }
  return s;
}

template MembraneState<double> evaluate(const MembraneProblem&, const double&, const double&);
template BeamState<double> evaluate(const BeamProblem&, const double&);

using Complex = std::complex<double>;
template MembraneState<Complex> evaluate(const MembraneProblem&, const Complex&, const Complex&);
template BeamState<Complex> evaluate(const BeamProblem&, const Complex&);

}  // namespace trammel::references::manufactured
