#include <algorithm>
#include <array>
#include <boost/math/special_functions/bessel.hpp>
#include <map>

#include "references/beams/programs.h"
#include "references/numerics/dense.h"
#include "references/numerics/real.h"

namespace trammel::references {

namespace {

Real bessel(bool second_kind, int n, const Real& x) {
  return second_kind ? boost::math::cyl_neumann(n, x) : boost::math::cyl_bessel_j(n, x);
}

/// Returns the Bessel function J_n(k r) or Y_n(k r) and its first two derivatives with respect to
/// r.
std::array<Real, 3> radial(bool second_kind, int n, const Real& k, const Real& r) {
  const Real x = k * r, value = bessel(second_kind, n, x);
  const Real slope = n * value / x - bessel(second_kind, n + 1, x);
  return {value, k * slope, k * k * ((n * n / (x * x) - 1) * value - slope / x)};
}

/// In-plane vibration of a free annular plate in plane stress with n waves around its circumference
/// (A. E. H. Love, A Treatise on the Mathematical Theory of Elasticity, 4th ed., chapter XXII). The
/// displacements follow from the potentials phi and psi, which are Bessel functions J_n and Y_n of
/// a r and of b r. For n = 0 the frequencies of radial and torsional motions form one list. With
/// a = w/c_p, c_p^2 = E/(rho (1 - nu^2)), b = w/c_s and c_s^2 = G/rho:
///
///   u_r = phi' + n psi/r,  u_t = -n phi/r - psi'.
///
/// The stresses vanish at both radii:
///
///   s_r ~ phi'' + nu (phi'/r - n^2 phi/r^2) + (1 - nu) n (psi/r)'.
///   t_rt ~ -2 n (phi/r)' - (psi'' - psi'/r + n^2 psi/r^2).
struct Annulus {
  Real inner, outer, c_p, c_s, nu;
};

/// Returns the determinant that vanishes at natural frequencies. Rows: s_r r^2 and t_rt r^2 at both
/// radii. Columns: phi = J_n, phi = Y_n, psi = J_n, psi = Y_n.
Real characteristic(const Annulus& annulus, int n, const Real& w) {
  const Real& nu = annulus.nu;
  Eigen::Matrix<Real, 4, 4> m;
  for (int edge = 0; edge < 2; ++edge) {
    const Real& r = edge == 0 ? annulus.inner : annulus.outer;
    for (int kind = 0; kind < 2; ++kind) {
      const auto [f, f1, f2] = radial(kind == 1, n, w / annulus.c_p, r);
      m(2 * edge, kind) = r * r * f2 + nu * (r * f1 - n * n * f);
      m(2 * edge + 1, kind) = -2 * n * (r * f1 - f);
      const auto [g, g1, g2] = radial(kind == 1, n, w / annulus.c_s, r);
      m(2 * edge, 2 + kind) = (1 - nu) * n * (r * g1 - g);
      m(2 * edge + 1, 2 + kind) = -(r * r * g2 - r * g1 + n * n * g);
    }
  }
  return m.determinant();
}

/// Returns the requested modes as pairs [n, k]: the k-th frequency, k >= 1, among the modes with n
/// waves around the circumference of the plate.
std::vector<std::pair<int, int>> wanted_modes(const Arguments& arguments) {
  std::vector<std::pair<int, int>> wanted;
  for (const Json& mode : arguments["modes"]) {
    if (!mode.is_array() || mode.size() != 2 || !mode[0].is_number_unsigned() ||
        !mode[1].is_number_unsigned() || mode[1] < 1) {
      arguments.fail("modes", "expected pairs of a number of waves and an index from 1");
    }
    wanted.emplace_back(mode[0].get<int>(), mode[1].get<int>());
  }
  return wanted;
}

}  // namespace

std::vector<Real> annular_plate_inplane_program(const Arguments& arguments) {
  const Real e = arguments.positive("E_Pa") / arguments.positive("rho_kg_m3");
  const Real nu = arguments.number("nu");
  const Annulus annulus{arguments.positive("inner_radius_m"), arguments.positive("outer_radius_m"),
                        sqrt(e / (1 - nu * nu)), sqrt(e / (2 * (1 + nu))), nu};
  if (annulus.inner >= annulus.outer)
    arguments.fail("outer_radius_m", "expected a radius above the inner radius");
  const auto wanted = wanted_modes(arguments);
  const Real step = annulus.c_s / annulus.outer / 50;
  std::map<int, int> counts;  // number n of waves -> number of frequencies to compute
  for (const auto& [n, k] : wanted) counts[n] = std::max(counts[n], k);
  std::map<int, std::vector<Real>> roots;
  for (const auto& [n, count] : counts) {
    roots[n] = first_roots(
        [&annulus, waves = n](const Real& w) { return characteristic(annulus, waves, w); }, step,
        step, count);
  }
  std::vector<Real> values;
  for (const auto& [n, k] : wanted) values.push_back(roots[n][k - 1] / (2 * pi<Real>()));
  return values;
}

/// Returns the exponent l of the displacements r^l at the distance r from a corner of a plate,
/// between a clamped and a free side. It satisfies
///
///   sin^2(l w) = (1 + k)^2/(4 k) - l^2 sin^2(w)/k.
///
/// The angle between the sides is w; k = (3 - nu)/(1 + nu) in plane stress, 3 - 4 nu in plane
/// strain. On uniform meshes of element size h, the errors of energies, displacements and
/// frequencies decrease as h^(2 l) if the elements have a higher order. Source: M. L. Williams,
/// Stress singularities resulting from various boundary conditions in angular corners of plates in
/// extension, J. Appl. Mech. 19, 1952.
std::vector<Real> wedge_exponent_program(const Arguments& arguments) {
  const std::vector<Real> a = arguments.numbers("clamped_side", 2);
  const std::vector<Real> b = arguments.numbers("free_side", 2);
  const Real product = sqrt((a[0] * a[0] + a[1] * a[1]) * (b[0] * b[0] + b[1] * b[1]));
  if (product == 0) arguments.fail("clamped_side", "expected directions [x, y] that are not zero");
  const Real angle = acos(Real((a[0] * b[0] + a[1] * b[1]) / product));
  const Real nu = arguments.number("nu");
  const bool stress = arguments.choice("plane", "stress", {"stress", "strain"}) == "stress";
  const Real k = stress ? Real((3 - nu) / (1 + nu)) : Real(3 - 4 * nu);
  const Real sine = sin(angle);
  const auto f = [&](const Real& l) {
    const Real s = sin(l * angle);
    return Real(s * s - (1 + k) * (1 + k) / (4 * k) + l * l * sine * sine / k);
  };
  // The grid of the root search avoids l = 1, which is a root for a corner without a singularity.
  return first_roots(f, Real("0.1"), Real("0.0013"), 1);
}

}  // namespace trammel::references
