#include <algorithm>
#include <array>

#include "references/beams/programs.h"
#include "references/numerics/dense.h"

/// Large-displacement equilibria of a plane chain of straight elastic beams, welded to each other.
/// They are found by shooting with Taylor series of degree 30 along the beams, and Newton's method
/// in extended precision. Source: E. Reissner, On one-dimensional finite-strain beam theory, ZAMP
/// 23, 1972, 795-804.
///
/// A section is at the point r and has the angle t, which is t0 in the undeformed chain. The part
/// of the chain after the section exerts the force F and the moment m on it. A beam is inextensible
/// if EA is absent, and has no shear deformation if GA is absent. With a = (cos t, sin t) and b =
/// (-sin t, cos t), the derivatives with respect to the undeformed arc length are
///
///   t' = t0' + m/EI,  r' = (1 + F.a/EA) a + (F.b/GA) b,  m' = -r' x F.
namespace trammel::references {

namespace {

constexpr std::size_t kDegree = 30;
using Series = std::array<Real, kDegree + 1>;

/// Returns the n-th coefficient of the product of two power series.
Real term(const Series& a, const Series& b, std::size_t n) {
  Real sum = 0;
  for (std::size_t i = 0; i <= n; ++i) sum += a[i] * b[n - i];
  return sum;
}

Real sum_at(const Series& a, const Real& h) {
  Real sum = 0;
  for (std::size_t n = a.size(); n-- > 0;) sum = sum * h + a[n];
  return sum;
}

/// Section of the loaded chain: its position and angle, and the force and moment that the next part
/// of the chain exerts on it.
struct Section {
  Real x, y, angle, moment, force_x, force_y;
};

struct Chain {
  std::vector<std::vector<Real>> nodes;  ///< rows x, y [m]
  Real EI, axial_compliance, shear_compliance;
  std::vector<std::vector<Real>> loads;  ///< rows: node, Fx, Fy, M
  std::array<bool, 3> end_held{};        ///< true if x, y, rotation are fixed at the end
  bool start_turns = false;
  int steps = 8;
};

/// Advances the section `at` by the distance h along a beam of the chain.
void advance(const Chain& chain, const Real& h, Section& at) {
  Series x{}, y{}, angle{}, moment{}, c{}, s{}, tangential{}, normal{}, turn{};
  x[0] = at.x, y[0] = at.y, angle[0] = at.angle, moment[0] = at.moment;
  c[0] = cos(at.angle), s[0] = sin(at.angle);
  const Real &Fx = at.force_x, &Fy = at.force_y;
  for (std::size_t n = 0; n < kDegree; ++n) {
    tangential[n] = chain.axial_compliance * (Fx * c[n] + Fy * s[n]) + Real(n == 0 ? 1 : 0);
    normal[n] = chain.shear_compliance * (Fy * c[n] - Fx * s[n]);
    turn[n] = moment[n] / chain.EI;
    const Real dx = term(tangential, c, n) - term(normal, s, n);
    const Real dy = term(tangential, s, n) + term(normal, c, n);
    const Real step(n + 1);
    x[n + 1] = dx / step, y[n + 1] = dy / step;
    angle[n + 1] = turn[n] / step;
    moment[n + 1] = (dy * Fx - dx * Fy) / step;
    c[n + 1] = -term(s, turn, n) / step;
    s[n + 1] = term(c, turn, n) / step;
  }
  at.x = sum_at(x, h), at.y = sum_at(y, h);
  at.angle = sum_at(angle, h), at.moment = sum_at(moment, h);
}

/// Returns the section at each node of the chain, after the loads on the node, by integration from
/// the start of the chain.
/// @param unknown  angle (free start) or moment of the first section, Fx, Fy, and the load factor
std::vector<Section> shoot(const Chain& chain, const RealVector& unknown) {
  Section at{chain.nodes[0][0],
             chain.nodes[0][1],
             chain.start_turns ? unknown[0] : Real(0),
             chain.start_turns ? Real(0) : unknown[0],
             unknown[1],
             unknown[2]};
  std::vector<Section> sections;
  for (std::size_t node = 0; node < chain.nodes.size(); ++node) {
    for (const std::vector<Real>& load : chain.loads) {
      if (load[0] != Real(node)) continue;
      if (node > 0) at.force_x -= unknown[3] * load[1], at.force_y -= unknown[3] * load[2];
      at.moment -= unknown[3] * load[3];
    }
    sections.push_back(at);
    if (node + 1 == chain.nodes.size()) break;
    const std::vector<Real>&a = chain.nodes[node], &b = chain.nodes[node + 1];
    const Real x = b[0] - a[0], y = b[1] - a[1];
    const Real length = sqrt(x * x + y * y), direction = atan2(y, x);
    at.angle += direction;
    for (int i = 0; i < chain.steps; ++i) advance(chain, length / chain.steps, at);
    at.angle -= direction;
  }
  return sections;
}

/// Returns the residuals of the conditions for x, y and rotation at the end of the chain. Each
/// residual is the displacement if the displacement is fixed, otherwise the force or moment.
RealVector end_residual(const Chain& chain, const RealVector& unknown) {
  const Section end = shoot(chain, unknown).back();
  RealVector missing(3);
  missing << (chain.end_held[0] ? Real(end.x - chain.nodes.back()[0]) : end.force_x),
      (chain.end_held[1] ? Real(end.y - chain.nodes.back()[1]) : end.force_y),
      (chain.end_held[2] ? end.angle : end.moment);
  return missing;
}

template <class F>
RealMatrix jacobian_by_differences(const F& f, RealVector at, Eigen::Index columns) {
  const RealVector value = f(at);
  RealMatrix J(value.size(), columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Real kept = at[j], step = Real(1e-20) * (1 + abs(kept));
    at[j] += step;
    J.col(j) = (f(at) - value) / step;
    at[j] = kept;
  }
  return J;
}

/// Returns the residuals at the end of the chain, and the determinant of their Jacobian. The
/// determinant vanishes at a limit point, where the load is stationary.
RealVector limit_point_residual(const Chain& chain, const RealVector& unknown) {
  RealVector value(4);
  value << end_residual(chain, unknown),
      jacobian_by_differences([&](const auto& u) { return end_residual(chain, u); }, unknown, 3)
          .determinant();
  return value;
}

/// Solves the n equations f = 0 by Newton's method for the first n unknowns.
template <class F>
void find_equilibrium(const Arguments& arguments, const F& f, RealVector& unknown) {
  for (int iteration = 0; iteration < 40; ++iteration) {
    const RealVector value = f(unknown);
    const RealMatrix J = jacobian_by_differences(f, unknown, value.size());
    const RealVector correction =
        solve(J, value, "the equations of equilibrium are singular", Real(1e-60));
    if (!isfinite(correction.sum())) break;
    unknown.head(value.size()) -= correction;
    const Real size =
        (correction.array().abs() / (1 + unknown.head(value.size()).array().abs())).maxCoeff();
    if (size < Real(1e-25)) return;
  }
  arguments.fail("nodes_m", "Newton's method does not converge to an equilibrium");
}

Real output(const Arguments& arguments, const Chain& chain, const std::string& name,
            const RealVector& unknown, const std::vector<Section>& sections) {
  if (name == "load_factor") return unknown[3];
  const std::size_t colon = name.find(':');
  const std::size_t node =
      colon == std::string::npos ? sections.size() : std::stoul(name.substr(colon + 1));
  if (node < sections.size()) {
    const Section& at = sections[node];
    const std::string what = name.substr(0, colon);
    if (what == "displacement_x_m") return at.x - chain.nodes[node][0];
    if (what == "displacement_y_m") return at.y - chain.nodes[node][1];
    if (what == "rotation_rad") return at.angle;
  }
  arguments.fail(
      "outputs",
      "expected load_factor, displacement_x_m:NODE, displacement_y_m:NODE or rotation_rad:NODE");
}

Chain read_chain(const Arguments& arguments) {
  Chain chain;
  chain.nodes = arguments.rows("nodes_m", 2);
  chain.EI = arguments.positive("EI_N_m2");
  if (arguments.has("EA_N")) chain.axial_compliance = 1 / arguments.positive("EA_N");
  if (arguments.has("GA_N")) chain.shear_compliance = 1 / arguments.positive("GA_N");
  chain.loads = arguments.rows("loads", 4);
  const std::vector<std::string> start = arguments.texts("start"), end = arguments.texts("end");
  const auto has = [](const std::vector<std::string>& words, const char* word) {
    return std::ranges::find(words, word) != words.end();
  };
  chain.start_turns = !has(start, "rotation");
  chain.end_held = {has(end, "x"), has(end, "y"), has(end, "rotation")};
  if (arguments.has("steps")) chain.steps = arguments.natural_number("steps");
  return chain;
}

}  // namespace

std::vector<Real> elastic_chain_program(const Arguments& arguments) {
  const Chain chain = read_chain(arguments);
  std::vector<Real> values;
  const auto record = [&](const RealVector& unknown) {
    const std::vector<Section> sections = shoot(chain, unknown);
    for (const std::string& name : arguments.texts("outputs"))
      values.push_back(output(arguments, chain, name, unknown, sections));
  };
  RealVector unknown = RealVector::Zero(4);
  if (arguments.has("load_factors")) {
    for (const Real& factor : arguments.numbers("load_factors")) {
      unknown[3] = factor;
      find_equilibrium(
          arguments, [&](const auto& u) { return end_residual(chain, u); }, unknown);
      record(unknown);
    }
  } else {
    for (const std::vector<Real>& guess : arguments.rows("limit_points", 4)) {
      unknown << guess[0], guess[1], guess[2], guess[3];
      find_equilibrium(
          arguments, [&](const auto& u) { return limit_point_residual(chain, u); }, unknown);
      record(unknown);
    }
  }
  return values;
}

}  // namespace trammel::references
