#include "references/beams/column_buckling.h"

#include <boost/math/special_functions/bessel.hpp>
#include <boost/multiprecision/cpp_complex.hpp>
#include <type_traits>

#include "references/numerics/roots.h"

namespace trammel::references {

namespace {

using std::cos;
using std::sin;

Equation end_load_equation(const std::string& ends) {
  if (ends == "clamped-free") {
    return equation([](const auto& x) { return cos(x); });
  }
  if (ends == "pinned-pinned") {
    return equation([](const auto& x) { return sin(x); });
  }
  if (ends == "clamped-pinned") {
    return equation([](const auto& x) { return sin(x) - x * cos(x); });
  }
  return equation([](const auto& x) { return sin(x / 2) * (sin(x / 2) - x / 2 * cos(x / 2)); });
}

Equation self_weight_equation() {
  return equation([](const auto& x) {
    using T = std::decay_t<decltype(x)>;
    return boost::math::cyl_bessel_j(T(-1) / 3, x);
  });
}

using Complex = boost::multiprecision::number<
    boost::multiprecision::complex_adaptor<boost::multiprecision::cpp_bin_float_50::backend_type>,
    boost::multiprecision::et_off>;

/// Beck's characteristic function over W^2, for real or complex W.
template <class T>
T beck(const T& W, const Real& p) {
  const T root = sqrt(T(p * p / 4) + W * W);
  const T a = sqrt(root + T(p / 2)), b = sqrt(root - T(p / 2));
  return T(p * p) / (W * W) + T(2) + T(2) * cos(a) * cosh(b) + T(p) / W * sin(a) * sinh(b);
}

/// Its least value between the two lowest roots, and where: 0 where they meet.
std::pair<Real, Real> beck_valley(const Real& p) {
  Real low = 3, high = 24;
  while (high - low > Real(1e-24)) {  // ternary search; the valley is flat to half the digits
    const Real third = (high - low) / 3;
    (beck(Real(low + third), p) < beck(Real(high - third), p) ? high : low) =
        beck(Real(low + third), p) < beck(Real(high - third), p) ? high - third : low + third;
  }
  return {beck(low, p), low};
}

Real flutter_load() {
  Real low = 19, high = 21;
  while (high - low > Real(1e-30)) {
    const Real middle = (low + high) / 2;
    (beck_valley(middle).first < 0 ? low : high) = middle;
  }
  return low;
}

/// The complex root of a p beyond the flutter load, by Newton's method from the valley.
Complex beck_root(const Real& p) {
  Complex W(beck_valley(p).second, Real(1));
  const Complex step(Real(1e-20));
  for (int i = 0; i < 60; ++i) {
    const Complex slope = (beck(Complex(W + step), p) - beck(Complex(W - step), p)) / (step + step);
    W -= beck(W, p) / slope;
  }
  return W;
}

}  // namespace

std::vector<double> becks_column_program(const Json& json) {
  const Arguments arguments(json, "",
                            {"output", "load_parameter", "EI_N_m2", "length_m", "mass_kg_per_m"});
  const std::string output =
      arguments.choice("output", "", {"flutter-load", "frequencies", "growth-rate"});
  const auto given = [&](const char* key) {
    return arguments.has(key) ? arguments.positive(key) : Real(1);
  };
  const Real EI = given("EI_N_m2"), L = given("length_m"), mass = given("mass_kg_per_m");
  if (output == "flutter-load") return to_doubles({flutter_load() * EI / (L * L)});
  const Real p = arguments.positive("load_parameter");
  const bool flutters = p > flutter_load();
  if (flutters != (output == "growth-rate"))
    arguments.fail("load_parameter", std::string("a load ") + (flutters ? "below" : "above") +
                                         " that of flutter, 20.05");
  const Real rate = sqrt(EI / mass) / (L * L);
  if (flutters) return to_doubles({Real(abs(beck_root(p).imag()) * rate)});
  std::vector<Real> values = first_roots(equation([&p](const auto& W) {
                                           using T = std::decay_t<decltype(W)>;
                                           return beck(T(W), p);
                                         }),
                                         0.5, 0.1, 2);
  for (Real& value : values) value *= rate / (2 * pi<Real>());
  return to_doubles(values);
}

std::vector<double> column_buckling_program(const Json& json) {
  const Arguments arguments(json, "",
                            {"ends", "load", "count", "EI_N_m2", "length_m", "weight_N_per_m"});
  const std::string ends = arguments.choice(
      "ends", "", {"clamped-free", "pinned-pinned", "clamped-pinned", "clamped-clamped"});
  const bool weight = arguments.choice("load", "", {"end", "self-weight"}) == "self-weight";
  if (weight && ends != "clamped-free") {
    arguments.fail("ends", "only a clamped-free column under its own weight is known here");
  }
  const Real L = arguments.has("length_m") ? arguments.positive("length_m") : Real(1);
  const Real EI = arguments.has("EI_N_m2") ? arguments.positive("EI_N_m2") : Real(1);
  const Real scale =
      weight ? Real(9 * EI /
                    (4 * L * L * L *
                     (arguments.has("weight_N_per_m") ? arguments.positive("weight_N_per_m")
                                                      : Real(1))))
             : Real(EI / (L * L));
  std::vector<Real> values = first_roots(weight ? self_weight_equation() : end_load_equation(ends),
                                         0.5, 0.1, arguments.count("count"));
  for (Real& value : values) value = scale * value * value;
  return to_doubles(values);
}

}  // namespace trammel::references
