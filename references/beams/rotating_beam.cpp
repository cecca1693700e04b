#include <algorithm>
#include <array>
#include <optional>

#include "references/beams/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

/// Bending vibration of a uniform Euler-Bernoulli cantilever on a hub that rotates steadily
/// (A. D. Wright et al., J. Appl. Mech. 49, 1982, 197-202), by power series about the hub in
/// extended precision. x is the distance from the hub over the length L, and r = R/L is the hub
/// ratio. The speed, the frequency and the tension of the undeformed beam are
///
///   eta = Omega sqrt(rho A L^4/EI),  mu = w sqrt(rho A L^4/EI),
///   t = eta^2 ((1 - x^2)/2 + r (1 - x)).
///
/// Flap (out of the plane of rotation), and lag (in the plane) of an axially rigid beam:
///
///   V'''' - (t V')' - mu^2 V = 0,
///   V'''' - (t V')' - (mu^2 + eta^2) V = 0.
///
/// Lag with the Coriolis coupling to axial motion U, s = EA L^2/EI:
///
///   V'''' - (t V')' - (mu^2 + eta^2) V - 2 eta mu U = 0,
///   s U'' + (mu^2 + eta^2) U + 2 eta mu V = 0.
namespace trammel::references {

namespace {

struct RotatingBeam {
  Real eta = 0;
  Real hub_ratio = 0;
  bool in_plane = false;
  std::optional<Real> axial_ratio;  ///< s = EA L^2/EI, for lag; no value: axially rigid
};

/// V'', V''' and U' at the tip of a rotating beam, for one solution of its equations. For a
/// vibration mode, these three derivatives vanish.
using Tip = std::array<Real, 3>;

/// Returns V'', V''' and U' at the tip of a rotating beam, for the solution that starts at the
/// clamped hub with V'' = a, V''' = b and U' = c.
Tip tip_of_series_solution(const RotatingBeam& beam, const Real& mu, const Tip& start) {
  const Real eta2 = beam.eta * beam.eta;
  const Real at_hub = Real(1) / 2 + beam.hub_ratio;  // tension over eta^2: at_hub - r x - x^2/2
  const Real m2 = beam.axial_ratio ? Real(mu * mu + eta2) : Real(mu * mu);
  const Real coupling = beam.axial_ratio ? Real(2 * beam.eta * mu) : Real(0);
  const Real s = beam.axial_ratio.value_or(Real(1));
  std::vector<Real> V = {0, 0, start[0] / 2, start[1] / 6};
  std::vector<Real> U = {0, start[2]};
  Tip tip = {start[0] + start[1], start[1], start[2]};
  Real largest = 1;
  int small_terms = 0;
  for (int k = 0; k < 4000; ++k) {
    const Real k1 = k + 1, k2 = k + 2;
    const Real tension =
        at_hub * k1 * k2 * V[k + 2] - beam.hub_ratio * k1 * k1 * V[k + 1] - Real(k) * k1 / 2 * V[k];
    V.push_back((eta2 * tension + m2 * V[k] + coupling * U[k]) / (k1 * k2 * (k + 3) * (k + 4)));
    U.push_back(-(m2 * U[k] + coupling * V[k]) / (s * k1 * k2));
    const Tip step = {V[k + 4] * (k + 4) * (k + 3), V[k + 4] * (k + 4) * (k + 3) * k2,
                      U[k + 2] * k2};
    for (int i = 0; i < 3; ++i) tip[i] += step[i];
    largest = std::max({largest, Real(abs(step[1])), Real(abs(step[2]))});
    // Terms of the power series whose exponents differ modulo four can be independent. The series
    // is therefore ended only after four successive small terms.
    const bool small = abs(step[0]) + abs(step[1]) + abs(step[2]) < Real(1e-60) * largest;
    small_terms = small ? small_terms + 1 : 0;
    if (small_terms == 4) break;
  }
  return tip;
}

Real characteristic(const RotatingBeam& beam, const Real& mu) {
  const Tip a = tip_of_series_solution(beam, mu, {1, 0, 0});
  const Tip b = tip_of_series_solution(beam, mu, {0, 1, 0});
  if (!beam.axial_ratio) return a[0] * b[1] - a[1] * b[0];
  const Tip c = tip_of_series_solution(beam, mu, {0, 0, 1});
  Eigen::Matrix<Real, 3, 3> m;
  m << a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2];
  return m.determinant();
}

/// Returns the first `count` natural frequencies mu of a rotating beam.
std::vector<Real> rotating_beam_roots(const RotatingBeam& beam, int count) {
  // The solutions grow like exp(eta sqrt(r + 1/2)) and become nearly proportional. Their
  // determinant therefore loses as many digits as this factor has. The limit 69 is a loss of 30
  // digits.
  if (beam.eta * sqrt(beam.hub_ratio + Real(0.5)) > 69)
    throw DerivationError("the beam rotates too fast to compute twenty correct digits");
  std::vector<Real> roots = first_roots([&](const Real& m) { return characteristic(beam, m); },
                                        Real("0.1"), Real("0.5"), count);
  if (!beam.in_plane || beam.axial_ratio) return roots;
  for (Real& root : roots) {
    const Real squared = root * root - beam.eta * beam.eta;
    if (!(squared > 0)) throw DerivationError("the beam is unstable in the plane of rotation");
    root = sqrt(squared);
  }
  return roots;
}

RotatingBeam read_bending_plane(const Arguments& arguments) {
  RotatingBeam beam;
  beam.in_plane = arguments.choice("plane", "", {"flap", "lag"}) == "lag";
  return beam;
}

}  // namespace

std::vector<Real> rotating_beam_roots_program(const Arguments& arguments) {
  RotatingBeam beam = read_bending_plane(arguments);
  beam.eta = arguments.not_negative("eta", 0);
  beam.hub_ratio = arguments.not_negative("hub_ratio", 0);
  if (arguments.has("axial_ratio")) beam.axial_ratio = arguments.positive("axial_ratio");
  if (beam.axial_ratio && !beam.in_plane)
    arguments.fail("axial_ratio", "requires bending in the plane of rotation");
  return rotating_beam_roots(beam, arguments.natural_number("count"));
}

std::vector<Real> rotating_beam_frequencies_program(const Arguments& arguments) {
  const Real L = arguments.positive("length_m");
  const Real scale = arguments.positive("thickness_m") *
                     sqrt(arguments.positive("E_Pa") / (12 * arguments.positive("rho_kg_m3"))) /
                     (L * L);  // sqrt(EI / rho A L^4)
  RotatingBeam beam = read_bending_plane(arguments);
  beam.eta = arguments.not_negative("angular_speed_rad_s", 0) / scale;
  beam.hub_ratio = arguments.not_negative("hub_radius_m", 0) / L;
  if (arguments.choice("axial", "rigid", {"rigid", "flexible"}) == "flexible" && beam.in_plane) {
    const Real thickness = arguments.positive("thickness_m");
    beam.axial_ratio = 12 * L * L / (thickness * thickness);
  }
  std::vector<Real> values = rotating_beam_roots(beam, arguments.natural_number("count"));
  for (Real& value : values) value *= scale / (2 * pi<Real>());
  return values;
}

}  // namespace trammel::references
