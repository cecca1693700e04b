#include <array>

#include "references/beams/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

/// Bending vibration of a clamped-clamped beam of constant thickness whose width is
/// b exp(-2 a x): its equations have constant coefficients. With r^2 = I/A, P = z^2 - a^2,
/// kG = kappa G / rho, e = E / rho,
///   Euler-Bernoulli:  P^2 = w^2 / (e r^2)
///   Timoshenko:       (kG P + w^2)(e r^2 P - kG + w^2 r^2) = -kG^2 P
/// and solutions exp(a x) {cosh z x, sinh z x}, whose deflection and rotation vanish at both ends.
namespace trammel::references {

namespace {

struct Beam {
  Real L, a, r2, e, kG;  ///< kG = 0: Euler-Bernoulli
};

/// C and S = sinh(z x)/z at the far end for z^2 of either sign, divided by cosh where hyperbolic.
std::array<Real, 2> wave(const Real& z2, const Real& L) {
  if (z2 > 0) {
    const Real z = sqrt(z2);
    return {Real(1), tanh(z * L) / z};
  }
  const Real z = sqrt(-z2);
  return {cos(z * L), sin(z * L) / z};
}

/// Both values of P, the smaller first.
std::array<Real, 2> exponents(const Beam& beam, const Real& w2) {
  if (beam.kG == 0) {
    const Real P = sqrt(w2 / (beam.e * beam.r2));
    return {-P, P};
  }
  const Real A = beam.kG * beam.e * beam.r2;
  const Real half = beam.r2 * w2 * (beam.kG + beam.e) / 2;
  const Real C = w2 * (w2 * beam.r2 - beam.kG);
  const Real root = sqrt(half * half - A * C);
  return {(-half - root) / A, (-half + root) / A};
}

/// Rows: deflection and rotation at both ends; columns: the four solutions. In terms of a potential
/// F the deflection is F' - a F and the rotation (P + w^2/kG) F; for Euler-Bernoulli F itself is
/// the deflection, F' + a F its slope.
Real characteristic(const Beam& beam, const Real& w) {
  const Real w2 = w * w;
  const auto P = exponents(beam, w2);
  Eigen::Matrix<Real, 4, 4> m;
  for (int i = 0; i < 2; ++i) {
    const Real z2 = P[i] + beam.a * beam.a;
    const auto [C, S] = wave(z2, beam.L);
    const Real unit = z2 > 0 ? Real(1 / cosh(sqrt(z2) * beam.L)) : Real(1);
    // value and derivative of C (column 2 i) and S (column 2 i + 1) at both ends
    const std::array<std::array<Real, 4>, 2> f = {{{unit, 0, C, z2 * S}, {0, unit, S, C}}};
    for (int j = 0; j < 2; ++j) {
      for (int end = 0; end < 2; ++end) {
        const Real& value = f[j][2 * end];
        const Real& slope = f[j][2 * end + 1];
        const bool thin = beam.kG == 0;
        m(2 * end, 2 * i + j) = thin ? value : Real(slope - beam.a * value);
        m(2 * end + 1, 2 * i + j) =
            thin ? Real(slope + beam.a * value) : Real((P[i] + w2 / beam.kG) * value);
      }
    }
  }
  return m.determinant();
}

}  // namespace

std::vector<Real> exponential_beam_program(const Arguments& arguments) {
  const Real thickness = arguments.positive("thickness_m");
  const Real e = arguments.positive("E_Pa") / arguments.positive("rho_kg_m3");
  Beam beam{arguments.positive("length_m"), arguments.number("width_rate_1_m") / 2,
            thickness * thickness / 12, e, 0};
  if (arguments.choice("beam", "euler-bernoulli", {"euler-bernoulli", "timoshenko"}) ==
      "timoshenko") {
    beam.kG = arguments.positive("shear_coefficient") * e / (2 * (1 + arguments.number("nu")));
  }
  const Real scale = sqrt(e * beam.r2) / (beam.L * beam.L);
  std::vector<Real> values = first_roots([&](const Real& w) { return characteristic(beam, w); },
                                         scale, 2 * scale, arguments.count("count"));
  for (Real& value : values) value /= 2 * pi<Real>();
  return values;
}

}  // namespace trammel::references
