#include <array>

#include "references/beams/programs.h"
#include "references/numerics/dense.h"

namespace trammel::references {

namespace {

Real frequency_equation(const BeamEnds& ends, const Real& b) {
  const std::string& kind = ends.kind;
  const Real sech = 1 / cosh(b);
  const Real moment = sin(b) + cos(b) * tanh(b), force = cos(b) * tanh(b) - sin(b);
  if (kind == "pinned-pinned") return sin(b);
  if (kind == "clamped-clamped" || kind == "free-free") return cos(b) - sech;
  if (kind == "clamped-pinned" || kind == "pinned-free") return force;
  if (kind == "clamped-guided") return moment;
  const Real &mu = ends.tip_mass_ratio, &j = ends.tip_inertia_ratio;
  return sech + cos(b) + mu * b * force - j * b * b * b * moment +
         mu * j * b * b * b * b * (sech - cos(b));
}

/// Bending vibration of a clamped-clamped beam of constant thickness and width b exp(-2 a x), at
/// the circular frequency w. Its equations have constant coefficients, with the solutions exp(a x)
/// cosh z x and exp(a x) sinh z x. Deflection and rotation vanish at both ends. With r^2 = I/A, P =
/// z^2 - a^2, kG = kappa G / rho and e = E / rho:
///
///   Euler-Bernoulli:  P^2 = w^2 / (e r^2)
///   Timoshenko:       (kG P + w^2)(e r^2 P - kG + w^2 r^2) = -kG^2 P
struct Beam {
  Real L, a, r2, e, kG;  ///< symbols as above; kG = 0: Euler-Bernoulli
};

/// Returns both roots P = z^2 - a^2 of the characteristic equation of an exponential beam at the
/// circular frequency w, the smaller root first. `w2` is w^2.
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

/// Returns the determinant of the clamped-clamped exponential beam, which vanishes at natural
/// frequencies. Rows: deflection and rotation at both ends. Columns: the four solutions. For
/// Timoshenko beams the deflection is F' - a F and the rotation (P + w^2/kG) F, where F is a
/// potential. For Euler-Bernoulli beams F is the deflection, and F' + a F is its slope.
Real frequency_equation(const Beam& beam, const Real& w) {
  const Real w2 = w * w;
  const auto P = exponents(beam, w2);
  Eigen::Matrix<Real, 4, 4> m;
  for (int i = 0; i < 2; ++i) {
    const Real z2 = P[i] + beam.a * beam.a;
    const auto [C, S] = scaled_cosine_and_integral(z2, beam.L);
    const Real unit = z2 > 0 ? Real(1 / cosh(sqrt(z2) * beam.L)) : Real(1);
    // The two solutions of the beam equation without the factor exp(a x): cosh z x in row f[0],
    // (sinh z x)/z in row f[1]. Each row has value and slope at x = 0, then at x = L. All entries
    // are divided by cosh z L if z^2 > 0.
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

/// Bending vibration of a clamped-free Euler-Bernoulli beam of rectangular section whose depth and
/// width vary linearly. The Rayleigh-Ritz method solves it with the functions s^2 x^k, k = 0 ...
/// 31, where s runs from 0 to 1 along the beam and x = 2 s - 1. The area A is of second and the
/// moment of inertia I of fourth degree in x, so that all integrals are sums of fractions.
///
/// A polynomial is stored as its coefficients of 1, x, x^2, ...
using Polynomial = std::vector<Real>;

Polynomial operator*(const Polynomial& a, const Polynomial& b) {
  Polynomial c(a.size() + b.size() - 1, Real(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) c[i + j] += a[i] * b[j];
  return c;
}

/// Returns dp/ds = 2 dp/dx of a polynomial p in x = 2 s - 1.
Polynomial polynomial_derivative(const Polynomial& p) {
  Polynomial d;
  for (std::size_t k = 1; k < p.size(); ++k) d.push_back(2 * Real(k) * p[k]);
  return d;
}

/// Returns the integral of a polynomial in x = 2 s - 1 over 0 <= s <= 1.
Real polynomial_integral(const Polynomial& p) {
  Real sum = 0;
  for (std::size_t k = 0; k < p.size(); k += 2) sum += p[k] / Real(k + 1);
  return sum;
}

/// Returns the linear function that is 1 at s = 0 and `ratio` at s = 1.
Polynomial line(const Real& ratio) {
  return {(1 + ratio) / 2, (ratio - 1) / 2};
}

/// Returns the Ritz values of 1/w of a tapered cantilever in descending order, where w is a
/// circular frequency. The length is 1, and E I and rho A are 1 at the clamped end. The Ritz values
/// for the `n` functions s^2 x^k are the singular values of L_K^-1 L_M, where the stiffness matrix
/// is K = L_K L_K^T and the mass matrix is M = L_M L_M^T.
RealVector ritz_periods(const Polynomial& depth, const Polynomial& width, std::size_t n) {
  const Polynomial A = depth * width, I = A * depth * depth;
  std::vector<Polynomial> shape(n), bend(n);
  for (std::size_t k = 0; k < n; ++k) {
    shape[k].assign(k, Real(0));
    for (const double c : {0.25, 0.5, 0.25}) shape[k].push_back(c);  // s^2 = ((1 + x) / 2)^2
    bend[k] = polynomial_derivative(polynomial_derivative(shape[k]));
  }
  RealMatrix K(n, n), M(n, n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      K(i, j) = polynomial_integral(I * bend[i] * bend[j]);
      M(i, j) = polynomial_integral(A * shape[i] * shape[j]);
    }
  }
  const Eigen::LLT<RealMatrix> stiffness(K), mass(M);
  const RealMatrix root = stiffness.matrixL().solve(RealMatrix(mass.matrixL()));
  return Eigen::JacobiSVD<RealMatrix>(root).singularValues();
}

}  // namespace

BeamEnds read_beam_ends(const Arguments& arguments) {
  BeamEnds ends;
  ends.kind = arguments.choice("ends", "",
                               {"clamped-free", "pinned-pinned", "clamped-clamped",
                                "clamped-pinned", "pinned-free", "free-free", "clamped-guided"});
  ends.tip_mass_ratio = arguments.not_negative("tip_mass_ratio", 0);
  ends.tip_inertia_ratio = arguments.not_negative("tip_inertia_ratio", 0);
  if (ends.kind != "clamped-free") {
    for (const char* key : {"tip_mass_ratio", "tip_inertia_ratio"}) {
      if (arguments.has(key)) arguments.fail(key, "requires a clamped-free beam");
    }
  }
  return ends;
}

std::vector<Real> beam_roots(const BeamEnds& ends, int count) {
  return first_roots([&](const Real& b) { return frequency_equation(ends, b); }, Real("0.001"),
                     Real("0.05"), count);
}

std::vector<Real> beam_modal_mass_program(const Arguments& arguments) {
  const Real mu = arguments.positive("tip_mass_ratio");
  std::vector<Real> shares;
  for (const Real& b : beam_roots({"clamped-free", mu, 0}, arguments.natural_number("count"))) {
    const Real sech = 1 / cosh(b);
    const Real force = cos(b) * tanh(b) - sin(b);
    const Real derivative_mu = b * force;
    const Real derivative_b = -sech * tanh(b) - sin(b) + mu * force +
                              mu * b * (cos(b) * sech * sech - sin(b) * tanh(b) - cos(b));
    shares.push_back(1 - 4 * (mu / b) * derivative_mu / derivative_b);
  }
  return shares;
}

std::vector<Real> beam_roots_program(const Arguments& arguments) {
  const BeamEnds ends = read_beam_ends(arguments);
  return beam_roots(ends, arguments.natural_number("count"));
}

std::vector<Real> beam_frequencies_program(const Arguments& arguments) {
  static_cast<void>(arguments.positive("width_m"));  // the width cancels in EI / rho A
  const Real length = arguments.positive("length_m");
  const Real thickness = arguments.positive("thickness_m");
  const Real radius_of_gyration = thickness / sqrt(Real(12));
  const Real wave_speed = sqrt(arguments.positive("E_Pa") / arguments.positive("rho_kg_m3"));
  const BeamEnds ends = read_beam_ends(arguments);
  std::vector<Real> frequencies;
  for (const Real& b : beam_roots(ends, arguments.natural_number("count"))) {
    const Real wave_number = b / length;
    frequencies.push_back(wave_number * wave_number * radius_of_gyration * wave_speed /
                          (2 * pi<Real>()));
  }
  return frequencies;
}

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
  std::vector<Real> values = first_roots([&](const Real& w) { return frequency_equation(beam, w); },
                                         scale, 2 * scale, arguments.natural_number("count"));
  for (Real& value : values) value /= 2 * pi<Real>();
  return values;
}

std::vector<Real> tapered_beam_program(const Arguments& arguments) {
  const std::vector<Real> t = arguments.numbers("thickness_m", 2),
                          b = arguments.numbers("width_m", 2);
  if (!(t[0] > 0 && t[1] > 0)) arguments.fail("thickness_m", "expected two positive numbers");
  if (!(b[0] > 0 && b[1] > 0)) arguments.fail("width_m", "expected two positive numbers");
  const Polynomial depth = line(t[1] / t[0]), width = line(b[1] / b[0]);
  constexpr std::size_t kFunctions = 32;
  const RealVector beam = ritz_periods(depth, width, kFunctions);
  const RealVector fewer = ritz_periods(depth, width, kFunctions - 2);
  const Real length = arguments.positive("length_m");
  const Real unit = arguments.positive("E_Pa") * t[0] * t[0] /
                    (12 * arguments.positive("rho_kg_m3") * length * length * length * length);
  std::vector<Real> values;
  for (int i = 0; i < arguments.natural_number("count"); ++i) {
    if (i >= fewer.size() || !(beam[i] / fewer[i] - 1 < Real("5e-15")))
      throw DerivationError("the Ritz values of mode " + std::to_string(i + 1) +
                            " have not converged");
    values.push_back(sqrt(unit) / (2 * pi<Real>() * beam[i]));
  }
  return values;
}

}  // namespace trammel::references
