#include "references/derivations/program.h"

#include "references/derivations/beam_modes.h"
#include "references/derivations/expression.h"

namespace trammel::derive {

const std::map<std::string, Program>& programs() {
  static const std::map<std::string, Program> table = {
      {"beam-frequencies",
       {"frequencies of one uniform Euler-Bernoulli beam [Hz] (Blevins 1979, Table 8-1)",
        "ends, count, length_m, E_Pa, rho_kg_m3, thickness_m (in the plane), width_m; clamped-free "
        "also tip_mass_ratio, tip_inertia_ratio",
        beam_frequencies_program}},
      {"beam-roots",
       {"roots beta L of its characteristic equation (Blevins 1979, Table 8-1)",
        "ends, count; clamped-free also tip_mass_ratio M/(rho A L), tip_inertia_ratio J/(rho A "
        "L^3)",
        beam_roots_program}},
      {"formula",
       {"closed formulas, one value each, in extended precision",
        "formulas (array of texts: + - * / ^, parentheses, sqrt, sin, cos, tan, exp, log, pi), "
        "values (object of numbers by name)",
        formula_program}},
  };
  return table;
}

std::vector<double> derive(const std::string& program, const Json& arguments) {
  const auto found = programs().find(program);
  if (found == programs().end()) {
    std::string names;
    for (const auto& entry : programs()) names += (names.empty() ? "" : ", ") + entry.first;
    throw DerivationError("no program '" + program + "'; there are " + names);
  }
  return found->second.run(arguments);
}

}  // namespace trammel::derive
