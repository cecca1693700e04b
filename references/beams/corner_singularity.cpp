#include "references/beams/corner_singularity.h"

#include "references/numerics/roots.h"

namespace trammel::references {

std::vector<double> wedge_exponent_program(const Json& json) {
  const Arguments arguments(json, "", {"clamped_side", "free_side", "nu", "plane"});
  const std::vector<Real> a = arguments.numbers("clamped_side", 2);
  const std::vector<Real> b = arguments.numbers("free_side", 2);
  const Real product = sqrt((a[0] * a[0] + a[1] * a[1]) * (b[0] * b[0] + b[1] * b[1]));
  if (product == 0) arguments.fail("clamped_side", "expected two sides that have a direction");
  const Real angle = acos(Real((a[0] * b[0] + a[1] * b[1]) / product));
  const Real nu = arguments.number("nu");
  const bool stress = arguments.choice("plane", "stress", {"stress", "strain"}) == "stress";
  const Real k = stress ? Real((3 - nu) / (1 + nu)) : Real(3 - 4 * nu);
  const Real sine = sin(angle);
  const auto f = [&](const auto& l) {
    using T = std::decay_t<decltype(l)>;
    const T s = sin(l * static_cast<T>(angle));
    return s * s - static_cast<T>((1 + k) * (1 + k) / (4 * k)) +
           l * l * static_cast<T>(sine * sine / k);
  };
  // A step that does not fall on 1, the root of a corner that is not singular.
  return to_doubles(first_roots(equation(f), 0.1, 0.0013, 1));
}

}  // namespace trammel::references
