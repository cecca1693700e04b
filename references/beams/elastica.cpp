#include <algorithm>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_2.hpp>

#include "references/beams/programs.h"
#include "references/numerics/real.h"

/// Exact large deflections of an inextensible cantilever of length L under a dead load at its tip,
/// by elliptic integrals.
namespace trammel::references {

namespace {

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

/// The columns of the table that are asked for: one with its length, or all of them without.
std::vector<Real> columns(const Arguments& arguments, const std::vector<Real>& table,
                          const std::array<const char*, 3>& names,
                          const std::array<bool, 3>& is_length) {
  const std::string output =
      arguments.choice("output", "all", {"all", names[0], names[1], names[2]});
  if (output == "all") {
    if (arguments.has("length_m")) arguments.fail("length_m", "expected an output beside it");
    return table;
  }
  const auto column = static_cast<std::size_t>(std::ranges::find(names, output) - names.begin());
  const Real unit = is_length.at(column) ? arguments.positive("length_m") : Real(1);
  std::vector<Real> chosen;
  for (std::size_t i = column; i < table.size(); i += 3) chosen.push_back(unit * table[i]);
  return chosen;
}

}  // namespace

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
    if (!(degrees > 0 && degrees < 180)) {
      arguments.fail("tip_angle_deg", "expected angles between 0 and 180");
    }
    const Real k = sin(degrees * pi<Real>() / 360);
    const Real K = ellint_1(k);
    values.push_back(4 * K * K / (pi<Real>() * pi<Real>()));
    values.push_back(2 * k / K);
    values.push_back(2 * ellint_2(k) / K - 2);
  }
  return columns(arguments, values, {"load", "lateral", "axial"}, {false, true, true});
}

}  // namespace trammel::references
