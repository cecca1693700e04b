#include "references/data/manufactured.h"

#include <Eigen/Core>
#include <boost/math/differentiation/autodiff.hpp>
#include <complex>

namespace trammel::references::manufactured {
namespace {

constexpr double kPi = 3.141592653589793238462643383279503;

using boost::math::differentiation::autodiff_fvar;
using boost::math::differentiation::make_fvar;

/// Derivatives of a function of x and y at a point: entry (i, j) has order i in x and order j in y.
using Field = Eigen::Matrix3d;

/// Function of x with its first four derivatives.
using Shape = autodiff_fvar<double, 4>;

/// Returns exp(k s) with its first two derivatives in s. For imaginary k, the real and imaginary
/// parts are cosines and sines.
Eigen::Vector3cd exponential(std::complex<double> k, double s) {
  return std::exp(k * s) * Eigen::Vector3cd(1, k, k * k);
}

/// Returns the displacements u and v of a membrane at a point [m], with their derivatives. Each
/// displacement is a sum of products of a function of x and a function of y.
std::array<Field, 2> displacement(const MembraneProblem& problem, double x, double y) {
  const double a = problem.amplitude, p = 1 / problem.length, q = 1 / problem.height;
  const auto sine = [](double k, double s) { return exponential({0, k}, s).imag().eval(); };
  const auto cosine = [](double k, double s) { return exponential({0, k}, s).real().eval(); };
  const auto linear = [](double k, double s) { return Eigen::Vector3d(k * s, k, 0); };
  const auto square = [](double k, double s) {
    return Eigen::Vector3d(k * k * s * s, 2 * k * k * s, 2 * k * k);
  };
  const Eigen::RowVector3d one(1, 0, 0), Y = linear(q, y).transpose();
  const Eigen::Vector3d X = linear(p, x), X2 = square(p, x);
  switch (problem.field) {
    case MembraneField::clamped:
      return {a * sine(kPi * p, x) * sine(kPi * q, y).transpose(),
              a * sine(2 * kPi * p, x) * sine(kPi * q, y).transpose()};
    case MembraneField::cantilever:
      return {a * sine(kPi / 2 * p, x) * cosine(kPi / 2 * q, y).transpose(),
              a * (one.transpose() - cosine(kPi / 2 * p, x)) *
                  exponential(q / 2, y).real().transpose()};
    case MembraneField::uniform_strain:
      return {a * X * one, a * (0.7 * X * one - 0.4 * one.transpose() * Y)};
    case MembraneField::linear_strain:
      break;
  }
  return {a * ((X + 0.6 * X2) * one - 0.8 * X * Y),
          a * ((0.7 * X + 0.5 * X2) * one + 0.3 * X * Y -
               one.transpose() * (0.4 * Y + 0.9 * square(q, y).transpose()))};
}

/// Returns the bending displacement of a beam [m]. It vanishes together with its first derivative
/// at x = 0.
Shape bending_shape(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  if (problem.field == BeamField::cubic) return problem.amplitude * xi * xi * (1 - 0.4 * xi);
  return problem.amplitude * (exp(xi) - 1 - xi + (1 - cos(3 * xi)) / 4);
}

/// Returns the axial displacement of a beam [m]. It vanishes at x = 0.
Shape axial_shape(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  return problem.amplitude / 2 * (problem.field == BeamField::cubic ? xi : Shape(sin(2 * xi)));
}

/// Returns the independent shear angle of a beam [rad]. It vanishes at x = 0.
Shape shear_angle(const BeamProblem& problem, double x) {
  const Shape xi = make_fvar<double, 4>(x) / problem.length;
  return problem.amplitude / (2 * problem.length) * sin(2 * xi);
}

}  // namespace

MembraneState evaluate(const MembraneProblem& problem, double x, double y) {
  const auto [u, v] = displacement(problem, x, y);
  const double nu = problem.nu, D = problem.E / (1 - nu * nu), G = problem.E / (2 * (1 + nu));
  const double inertia = problem.rho * problem.omega * problem.omega;
  MembraneState s;
  s.displacement = {u(0, 0), v(0, 0)};
  s.rotation = 0.5 * (v(1, 0) - u(0, 1));
  s.strain = {u(1, 0), v(0, 1), u(0, 1) + v(1, 0)};
  s.stress = {D * (u(1, 0) + nu * v(0, 1)), D * (v(0, 1) + nu * u(1, 0)), G * (u(0, 1) + v(1, 0))};
  s.body_force = {
      -D * (u(2, 0) + nu * v(1, 1)) - G * (u(0, 2) + v(1, 1)) - inertia * s.displacement[0],
      -D * (v(0, 2) + nu * u(1, 1)) - G * (u(1, 1) + v(2, 0)) - inertia * s.displacement[1]};
  return s;
}

std::array<bool, 2> fixed_displacements(const MembraneProblem& problem, double x, double y) {
  const double dx = 1e-9 * problem.length, dy = 1e-9 * problem.height;
  const bool left = x < dx, bottom = y < dy;
  const bool is_on_edge = left || bottom || x > problem.length - dx || y > problem.height - dy;
  if (problem.field == MembraneField::clamped) return {is_on_edge, is_on_edge};
  return {left, left && (bottom || problem.field == MembraneField::cantilever)};
}

BeamState evaluate(const BeamProblem& problem, double x) {
  const Shape u = axial_shape(problem, x), w = bending_shape(problem, x);
  const double square = problem.omega * problem.omega, EI = problem.EI;
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
  if (problem.shear != ShearStrain::none)
    s.moment_load -= problem.inertia_per_length * square * s.rotation;
  return s;
}

}  // namespace trammel::references::manufactured
