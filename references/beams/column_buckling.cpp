#include "references/beams/column_buckling.h"

#include <boost/math/special_functions/bessel.hpp>
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

}  // namespace

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
