#include <array>
#include <boost/math/special_functions/bessel.hpp>
#include <boost/multiprecision/cpp_complex.hpp>

#include "references/beams/programs.h"
#include "references/numerics/real.h"

/// Elastic buckling of one uniform column (S. P. Timoshenko, J. M. Gere, Theory of Elastic
/// Stability, 2nd ed., chapter 2). End loads P = x^2 EI/L^2 with
///   clamped-free cos x = 0, pinned-pinned sin x = 0, clamped-pinned tan x = x,
///   clamped-clamped sin(x/2) (tan(x/2) - x/2) = 0;
/// own weight q L = (9/4) j^2 EI/L^2, clamped-free, J_{-1/3}(j) = 0.
namespace trammel::references {

namespace {

Real end_load_function(const std::string& ends, const Real& x) {
  if (ends == "clamped-free") return cos(x);
  if (ends == "pinned-pinned") return sin(x);
  if (ends == "clamped-pinned") return sin(x) - x * cos(x);
  return sin(x / 2) * (sin(x / 2) - x / 2 * cos(x / 2));
}

using Complex = boost::multiprecision::number<
    boost::multiprecision::complex_adaptor<boost::multiprecision::cpp_bin_float_50::backend_type>,
    boost::multiprecision::et_off>;

/// A cantilever under a force p at its tip and q spread over it, both along its tangent.
struct Follower {
  Real p, q;
};

/// Characteristic function for real or complex W: with x from the tip, w'''' + (p + q x) w'' = W^2
/// w by power series, w'' = w''' = 0 at x = 0; the determinant of w = w' = 0 at x = 1.
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

/// Its least value between the two lowest roots, and where: 0 where they meet.
std::pair<Real, Real> valley(const Follower& load) {
  Real low = 3, high = 24;
  while (high - low > Real(1e-24)) {  // ternary search; the valley is flat to half the digits
    const Real third = (high - low) / 3;
    const bool left = follower_determinant(Real(low + third), load) <
                      follower_determinant(Real(high - third), load);
    (left ? high : low) = left ? high - third : low + third;
  }
  return {follower_determinant(low, load), low};
}

/// Returns true if the two lowest roots have met.
bool flutters(const Follower& load) {
  return valley(load).first > 0;
}

Real flutter_load(bool spread) {
  Real low = spread ? 39 : 19, high = low + 2;
  while (high - low > Real(1e-20)) {
    const Real middle = (low + high) / 2;
    (flutters(spread ? Follower{0, middle} : Follower{middle, 0}) ? high : low) = middle;
  }
  return low;
}

/// The complex root beyond the flutter load, by Newton's method from the valley.
Complex complex_root(const Follower& load) {
  Complex W(valley(load).second, Real(1));
  const Complex step(Real(1e-20));
  for (int i = 0; i < 20; ++i) {
    const Complex slope = (follower_determinant(Complex(W + step), load) -
                           follower_determinant(Complex(W - step), load)) /
                          (step + step);
    W -= follower_determinant(W, load) / slope;
  }
  return W;
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
  const bool beyond = flutters(load);
  if (beyond != (output == "growth-rate"))
    arguments.fail("load_parameter",
                   std::string("a load ") + (beyond ? "below" : "above") + " that of flutter");
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
  if (weight && ends != "clamped-free") {
    arguments.fail("ends", "only a clamped-free column under its own weight is known here");
  }
  const Real L = arguments.positive("length_m", 1), EI = arguments.positive("EI_N_m2", 1);
  const Real scale = weight
                         ? Real(9 * EI / (4 * L * L * L * arguments.positive("weight_N_per_m", 1)))
                         : Real(EI / (L * L));
  const auto characteristic = [&](const Real& x) {
    return weight ? boost::math::cyl_bessel_j(Real(-1) / 3, x) : end_load_function(ends, x);
  };
  std::vector<Real> values =
      first_roots(characteristic, Real("0.5"), Real("0.1"), arguments.count("count"));
  for (Real& value : values) value = scale * value * value;
  return values;
}

}  // namespace trammel::references
