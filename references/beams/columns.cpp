#include <algorithm>
#include <array>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>
#include <boost/math/tools/minima.hpp>
#include <boost/multiprecision/cpp_complex.hpp>

#include "references/beams/programs.h"
#include "references/numerics/real.h"

namespace trammel::references {

namespace {

/// Characteristic function of the elastic buckling of a uniform column (S. P. Timoshenko, J. M.
/// Gere, Theory of Elastic Stability, 2nd ed., chapter 2). Critical end loads are P = x^2 EI/L^2.
/// The number x is a root of an equation that depends on the ends:
///
///   clamped-free cos x = 0, pinned-pinned sin x = 0, clamped-pinned tan x = x,
///   clamped-clamped sin(x/2) (tan(x/2) - x/2) = 0.
///
/// A clamped-free column buckles under its own weight q per unit length at q L = (9/4) j^2 EI/L^2,
/// with J_{-1/3}(j) = 0.
Real characteristic_function_of_end_load(const std::string& ends, const Real& x) {
  if (ends == "clamped-free") return cos(x);
  if (ends == "pinned-pinned") return sin(x);
  if (ends == "clamped-pinned") return sin(x) - x * cos(x);
  return sin(x / 2) * (sin(x / 2) - x / 2 * cos(x / 2));
}

using Complex = boost::multiprecision::number<
    boost::multiprecision::complex_adaptor<boost::multiprecision::cpp_bin_float_50::backend_type>,
    boost::multiprecision::et_off>;

/// Follower loads along the tangent of a cantilever: a force p at the tip and a load q per length.
struct Follower {
  Real p, q;
};

/// Returns the characteristic function of a cantilever under follower loads for a real or complex
/// dimensionless frequency W. It is the determinant of the clamping conditions w = w' = 0 at x = 1.
/// The deflection is w, and x is the distance from the tip. A power series that satisfies w'' =
/// w''' = 0 at the tip solves
///
///   w'''' + (p + q x) w'' = W^2 w.
template <class T>
T follower_determinant(const T& W, const Follower& load) {
  std::array<T, 2> value, slope;
  for (std::size_t s = 0; s < 2; ++s) {
    std::array<T, 100> a{};
    a[s] = T(1);
    value[s] = slope[s] = T(0);
    for (std::size_t n = 0; n < a.size(); ++n) {
      value[s] += a[n], slope[s] += T(Real(n)) * a[n];
      if (n + 4 >= a.size()) continue;
      a[n + 4] = (W * W * a[n] - T(load.p * ((n + 2) * (n + 1))) * a[n + 2] -
                  T(load.q * ((n + 1) * n)) * a[n + 1]) /
                 T(Real((n + 4) * (n + 3) * (n + 2) * (n + 1)));
    }
  }
  return value[0] * slope[1] - value[1] * slope[0];
}

/// Returns the minimum of the characteristic function between its two lowest roots W, and the W of
/// this minimum. The minimum is 0 if the roots meet, and positive beyond the flutter load.
std::pair<Real, Real> lowest_value(const Follower& load) {
  const auto determinant = [&](const Real& W) { return follower_determinant(W, load); };
  constexpr int kBits = 80;  // round-off hides half of the digits of a minimum
  const auto [W, least] =
      boost::math::tools::brent_find_minima(determinant, Real(3), Real(24), kBits);
  return {least, W};
}

Real flutter_load(bool spread) {
  Real low = spread ? 39 : 19, high = low + 2;
  while (high - low > Real(1e-20)) {
    const Real middle = (low + high) / 2;
    const bool flutter = lowest_value(spread ? Follower{0, middle} : Follower{middle, 0}).first > 0;
    (flutter ? high : low) = middle;
  }
  return low;
}

/// Returns the complex root W of the characteristic function beyond the flutter load. Newton's
/// method starts from the minimum of the function.
Complex complex_root(const Follower& load) {
  Complex W(lowest_value(load).second, Real(1));
  const Complex step(Real(1e-20));
  for (int i = 0; i < 20; ++i) {
    const Complex slope = (follower_determinant(Complex(W + step), load) -
                           follower_determinant(Complex(W - step), load)) /
                          (step + step);
    W -= follower_determinant(W, load) / slope;
  }
  return W;
}

/// Exact large deflections of an inextensible cantilever of length L under a dead load at its tip,
/// by elliptic integrals.
using boost::math::ellint_1;
using boost::math::ellint_2;

struct Modulus {
  Real k, amplitude;
};

Modulus modulus(const Real& tip_angle) {
  const Real k = sqrt((1 + sin(tip_angle)) / 2);
  return {k, asin(1 / (k * sqrt(Real(2))))};
}

Real load_parameter(const Real& tip_angle) {
  const auto [k, t] = modulus(tip_angle);
  const Real root = ellint_1(k) - ellint_1(k, t);
  return root * root;
}

/// Returns a table of three dimensionless columns row by row. If the argument output names a
/// column, returns only this column. A column of lengths is then multiplied by the argument
/// length_m.
std::vector<Real> columns(const Arguments& arguments, const std::vector<Real>& table,
                          const std::array<const char*, 3>& names,
                          const std::array<bool, 3>& is_length) {
  const auto output = arguments.choice("output", "all", {"all", names[0], names[1], names[2]});
  if (output == "all") {
    if (arguments.has("length_m")) arguments.fail("length_m", "requires an output");
    return table;
  }
  const auto column = static_cast<std::size_t>(std::ranges::find(names, output) - names.begin());
  const Real unit = is_length.at(column) ? arguments.positive("length_m") : Real(1);
  std::vector<Real> chosen;
  for (std::size_t i = column; i < table.size(); i += 3) chosen.push_back(unit * table[i]);
  return chosen;
}

}  // namespace

std::vector<Real> becks_column_program(const Arguments& arguments) {
  const std::string output =
      arguments.choice("output", "", {"flutter-load", "frequencies", "growth-rate"});
  const bool spread = arguments.choice("load", "tip", {"tip", "spread"}) == "spread";
  const Real EI = arguments.positive("EI_N_m2", 1), L = arguments.positive("length_m", 1),
             mass = arguments.positive("mass_kg_per_m", 1);
  if (output == "flutter-load")
    return {flutter_load(spread) * EI / (spread ? Real(L * L * L) : Real(L * L))};
  const Real parameter = arguments.positive("load_parameter");
  const Follower load = spread ? Follower{0, parameter} : Follower{parameter, 0};
  const bool beyond = lowest_value(load).first > 0;  // flutter: the two lowest roots are complex
  if (beyond != (output == "growth-rate"))
    arguments.fail("load_parameter", std::string("expected a load ") +
                                         (beyond ? "below" : "above") + " the flutter load");
  const Real rate = sqrt(EI / mass) / (L * L);
  if (beyond) return {Real(abs(complex_root(load).imag()) * rate)};
  std::vector<Real> values =
      first_roots([&load](const Real& W) { return follower_determinant(W, load); }, Real("0.5"),
                  Real("0.1"), 2);
  for (Real& value : values) value *= rate / (2 * pi<Real>());
  return values;
}

std::vector<Real> column_buckling_program(const Arguments& arguments) {
  const std::string ends = arguments.choice(
      "ends", "", {"clamped-free", "pinned-pinned", "clamped-pinned", "clamped-clamped"});
  const bool weight = arguments.choice("load", "", {"end", "self-weight"}) == "self-weight";
  if (weight && ends != "clamped-free")
    arguments.fail("ends", "self-weight requires a clamped-free column");
  const Real L = arguments.positive("length_m", 1), EI = arguments.positive("EI_N_m2", 1);
  const Real scale = weight
                         ? Real(9 * EI / (4 * L * L * L * arguments.positive("weight_N_per_m", 1)))
                         : Real(EI / (L * L));
  const auto characteristic = [&](const Real& x) {
    return weight ? boost::math::cyl_bessel_j(Real(-1) / 3, x)
                  : characteristic_function_of_end_load(ends, x);
  };
  std::vector<Real> values =
      first_roots(characteristic, Real("0.5"), Real("0.1"), arguments.natural_number("count"));
  for (Real& value : values) value = scale * value * value;
  return values;
}

std::vector<Real> elastica_tip_force_program(const Arguments& arguments) {
  std::vector<Real> values;
  for (const Real& load : arguments.numbers("load_parameter")) {
    if (!(load > 0)) arguments.fail("load_parameter", "expected positive numbers");
    const Real right = pi<Real>() / 2 * (1 - Real(1e-20));
    const Real angle = refined_root([&](const Real& phi) { return load_parameter(phi) - load; },
                                    Real(1e-20), right);
    const auto [k, t] = modulus(angle);
    values.push_back(1 - 2 * (ellint_2(k) - ellint_2(k, t)) / sqrt(load));
    values.push_back(1 - sqrt(2 * sin(angle) / load));
    values.push_back(angle);
  }
  return columns(arguments, values, {"transverse", "shortening", "angle"}, {true, true, false});
}

std::vector<Real> elastica_column_program(const Arguments& arguments) {
  std::vector<Real> values;
  for (const Real& degrees : arguments.numbers("tip_angle_deg")) {
    if (!(degrees > 0 && degrees < 180))
      arguments.fail("tip_angle_deg", "expected angles between 0 and 180");
    const Real k = sin(degrees * pi<Real>() / 360), K = ellint_1(k);
    values.push_back(4 * K * K / (pi<Real>() * pi<Real>()));
    values.push_back(2 * k / K);
    values.push_back(2 * ellint_2(k) / K - 2);
  }
  return columns(arguments, values, {"load", "lateral", "axial"}, {false, true, true});
}

}  // namespace trammel::references
