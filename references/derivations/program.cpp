#include "references/derivations/program.h"

#include "references/derivations/beam_modes.h"
#include "references/derivations/expression.h"
#include "references/derivations/unit_load.h"
#include "references/derivations/wittrick_williams.h"

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
      {"beam-share",
       {"the beam's share of the modal mass of a cantilever with a tip mass",
        "count, tip_mass_ratio M/(rho A L)", beam_share_program}},
      {"frame-count",
       {"how many natural frequencies of a planar frame lie below one, rigid motions included, by "
        "Wittrick and Williams (1971)",
        "model (as in a case file; or manipulator, pose), below_Hz", frame_count_program}},
      {"frame-frequencies",
       {"exact elastic natural frequencies of a planar frame [Hz] by the dynamic stiffness method "
        "and "
        "the count of Wittrick and Williams (1971)",
        "model (as in a case file; or manipulator, pose), count", frame_frequencies_program}},
      {"frame-statics",
       {"exact statics of a planar frame by the unit-load method",
        "model (as in a case file; or manipulator, pose, loads), outputs (displacement_x_m:NODE, "
        "rotation_rad:NODE, reaction_y_N:NODE, bending_moment_N_m:MEMBER.end, ...)",
        frame_statics_program}},
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
