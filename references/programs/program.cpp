#include "references/programs/program.h"

#include "references/beams/annular_membrane.h"
#include "references/beams/beam_modes.h"
#include "references/beams/column_buckling.h"
#include "references/beams/corner_singularity.h"
#include "references/beams/deep_beam.h"
#include "references/beams/elastic_chain.h"
#include "references/beams/elastica.h"
#include "references/beams/exponential_beam.h"
#include "references/beams/parallelogram_chain.h"
#include "references/beams/pendulum.h"
#include "references/beams/rotating_beam.h"
#include "references/beams/run_up.h"
#include "references/beams/tapered_beam.h"
#include "references/frames/frame_buckling.h"
#include "references/frames/frame_sensitivity.h"
#include "references/frames/frame_statics.h"
#include "references/frames/wittrick_williams.h"
#include "references/manipulator/assembly_modes.h"
#include "references/manipulator/manipulator_motion.h"
#include "references/manipulator/manipulator_torques.h"
#include "references/manipulator/moving_links.h"
#include "references/manipulator/moving_platform.h"
#include "references/manipulator/nadaraya_watson.h"
#include "references/numerics/expression.h"
#include "references/programs/parameter_sweep.h"
#include "references/programs/proofs.h"

namespace trammel::references {

const std::map<std::string, Program>& programs() {
  static const std::map<std::string, Program> table = {
      {"annular-membrane",
       {"in-plane frequencies of a free annular plate [Hz] by Bessel functions (Love)",
        "inner_radius_m, outer_radius_m, E_Pa, rho_kg_m3, nu, modes (pairs [waves, number])",
        annular_membrane_program}},
      {"assembly-modes",
       {"all poses of the planar 3-RRR at given angles of its actuators, their number proved",
        "base_m, platform_m, proximal_m, distal_m, angles_rad, output (count | poses)",
        assembly_modes_program}},
      {"becks-column",
       {"cantilever under forces that follow it, at its tip (Beck) or spread over it (Leipholz): "
        "flutter load, frequencies (Bolotin 1963)",
        "output (flutter-load | frequencies | growth-rate), load (tip | spread), load_parameter P "
        "L^2/EI or q L^3/EI, EI_N_m2, length_m, mass_kg_per_m",
        becks_column_program}},
      {"column-buckling",
       {"critical loads of one uniform column (Timoshenko and Gere, chapter 2)",
        "ends, load (end | self-weight), count, EI_N_m2, length_m, weight_N_per_m",
        column_buckling_program}},
      {"deep-beam-response",
       {"simply supported Timoshenko beam under a uniform load, by its exact modes (NAFEMS 5H, 5T)",
        "length_m, thickness_m, width_m, E_Pa, rho_kg_m3, nu, shear_coefficient, load_N_per_m, "
        "damping_ratio (or rayleigh_mass_1_s, rayleigh_stiffness_s), response (static | "
        "harmonic-peak | step-peak), outputs (displacement_m, stress_Pa, frequency_Hz, time_s)",
        deep_beam_program}},
      {"elastic-chain",
       {"equilibria and limit points of a chain of straight elastic pieces at any displacement, by "
        "shooting (Reissner 1972)",
        "nodes_m, EI_N_m2, EA_N, GA_N, start and end (x, y, rotation held), loads (arrays node, "
        "Fx, "
        "Fy, M), load_factors or limit_points (guesses), outputs, steps",
        elastic_chain_program}},
      {"elastica-column",
       {"cantilever column beyond buckling: F/Fcr, lateral and axial displacement over L",
        "tip_angle_deg (array), output (all | load | lateral | axial), length_m",
        elastica_column_program}},
      {"elastica-tip-force",
       {"cantilever under a transverse dead load: v/L, u/L, tip angle (Bisshopp and Drucker 1945)",
        "load_parameter (array of P L^2/EI), output (all | transverse | shortening | angle), "
        "length_m",
        elastica_tip_force_program}},
      {"exponential-beam",
       {"frequencies of a clamped-clamped beam of exponential width [Hz]",
        "length_m, thickness_m, width_rate_1_m, E_Pa, rho_kg_m3, count, beam; for timoshenko nu, "
        "shear_coefficient",
        exponential_beam_program}},
      {"parallelogram-chain",
       {"the chain of N four-bar loops of the IFToMM benchmark A02 by elliptic functions",
        "loops, length_m, gravity_m_s2, start_speed_m_s, times_s, output (position | velocity)",
        parallelogram_chain_program}},
      {"pendulum",
       {"plane pendulum of any amplitude by elliptic functions: period [s] or x, y [m]",
        "length_m, gravity_m_s2, start_angle_deg, output (period | position | tension of 1 kg), "
        "times_s",
        pendulum_program}},
      {"rotating-beam-frequencies",
       {"a steadily rotating cantilever's bending frequencies [Hz] by power series",
        "length_m, hub_radius_m, E_Pa, rho_kg_m3, thickness_m (in the direction of bending), "
        "angular_speed_rad_s, plane (flap | lag), count, axial (rigid | flexible)",
        rotating_beam_frequencies_program}},
      {"rotating-beam-roots",
       {"the same without dimension: w sqrt(rho A L^4/EI)",
        "eta, hub_ratio, plane, count, axial_ratio", rotating_beam_roots_program}},
      {"run-up",
       {"run-up of an unbalanced rotor through the resonance of its carriage (Lewis 1932) [m]",
        "unbalance_m, angular_frequency_rad_s, speed_rad_s, duration_s, times_s", run_up_program}},
      {"tapered-beam",
       {"bending frequencies of a clamped-free strip of linear depth and width [Hz] by Ritz",
        "length_m, E_Pa, rho_kg_m3, thickness_m and width_m (each [clamped, free end]), count",
        tapered_beam_program}},
      {"beam-frequencies",
       {"frequencies of one uniform Euler-Bernoulli beam [Hz] (Blevins 1979, Table 8-1)",
        "ends, count, length_m, E_Pa, rho_kg_m3, thickness_m (in the plane), width_m; clamped-free "
        "also tip_mass_ratio, tip_inertia_ratio",
        beam_frequencies_program}},
      {"beam-roots",
       {"roots beta L of its characteristic equation (Blevins 1979, Table 8-1)",
        "ends, count; clamped-free also tip_mass_ratio M/(rho A L), tip_inertia_ratio J/(rho A "
        "L^3)",
        beam_roots_program, prove_beam_roots}},
      {"beam-share",
       {"the beam's share of the modal mass of a cantilever with a tip mass",
        "count, tip_mass_ratio M/(rho A L)", beam_modal_mass_program}},
      {"frame-buckling",
       {"factors of the loads at which a planar frame buckles, by the count of Wittrick and "
        "Williams "
        "at vanishing frequency",
        "model (as in a case file; or manipulator, pose, loads), count", frame_buckling_program}},
      {"frame-count",
       {"how many natural frequencies of a planar frame lie below one, rigid motions included, by "
        "Wittrick and Williams (1971)",
        "model (as in a case file; or manipulator, pose), below_Hz", frame_count_program}},
      {"frame-frequencies",
       {"exact elastic natural frequencies of a planar frame [Hz] by the dynamic stiffness method "
        "and "
        "the count of Wittrick and Williams (1971)",
        "model (as in a case file; or manipulator, pose), count", frame_frequencies_program,
        prove_frame_frequencies}},
      {"frame-frequency-sensitivity",
       {"derivatives of a planar frame's exact natural frequencies with respect to its numbers, by "
        "extrapolated differences in 50 digits",
        "model (as in a case file; or manipulator, pose), pointers (to numbers that change "
        "together), step, count",
        frame_sensitivity_program}},
      {"frame-statics",
       {"exact statics of a planar frame by the unit-load method",
        "model (as in a case file; or manipulator, pose, loads), outputs (displacement_x_m:NODE, "
        "rotation_rad:NODE, reaction_y_N:NODE, bending_moment_N_m:MEMBER.end, ...)",
        frame_statics_program}},
      {"grnn",
       {"general regression neural network by its printed formula (Specht 1991; paper Eq. 36, 37)",
        "inputs, outputs, queries (arrays of rows), sigma or spread (MATLAB's newgrnn); the "
        "outputs at the first query, then at the next",
        grnn_program}},
      {"manipulator-grnn",
       {"the same, trained with the torques along a path as inputs and the angles and velocities "
        "of "
        "the active joints as outputs",
        "manipulator, trajectory, step_s, train (points, from the first), sigma, queries (points), "
        "output (angles | velocities), force_N, moment_N_m, gravity_m_s2; at A1 at every query, at "
        "A2, at A3",
        manipulator_grnn_program}},
      {"manipulator-motion",
       {"the rigid planar 3-RRR along a path or under constant torques: joints, bodies, powers, "
        "tensions, singularities",
        "as manipulator-torques, outputs (active_angle_rad:A1, kinetic_energy_J, ...), at_rest, "
        "torque_N_m",
        manipulator_motion_program}},
      {"manipulator-torques",
       {"torques of the rigid planar 3-RRR along a path [N m], Newton and Euler for each of its "
        "seven bodies",
        "manipulator, trajectory (circle | line | rest_to_rest | spline), times_s, force_N, "
        "moment_N_m, gravity_m_s2; torques at A1 at all times, then A2, then A3",
        manipulator_torques_program}},
      {"moving-links",
       {"motion of a 3-RRR whose links have mass and next to no stiffness, beside that along a "
        "path",
        "manipulator, trajectory, force_N, moment_N_m, mass_damping_per_s, times_s, outputs "
        "(displacement_x_m:P, platform_rotation_rad, torque_N_m:A1, ...)",
        moving_links_program}},
      {"moving-platform",
       {"vibration of a 3-RRR's platform on massless links, hinged at both ends of the distal "
        "ones, "
        "about its motion along a path under a load with a history",
        "manipulator, trajectory, force_N, moment_N_m, load_history (time_s, factor), rate_terms, "
        "times_s, output (displacement_x_m, axial_force_N:B1-C1, torque_N_m:A1, ...)",
        moving_platform_program}},
      {"wedge-exponent",
       {"the power of the distance with which displacements grow from a corner between a clamped "
        "and "
        "a free side (Williams 1952)",
        "clamped_side, free_side (directions from the corner), nu, plane (stress | strain)",
        wedge_exponent_program}},
      {"formula",
       {"closed formulas, one value each, in extended precision",
        "formulas (array of texts: + - * / ^, parentheses, sqrt, sin, cos, tan, exp, log, pi), "
        "values (object of numbers by name)",
        formula_program}},
      {"swept",
       {"another program at each of several values: the truth of a parameter study",
        "program, arguments, pointers (into the arguments) and values, or patches",
        parameter_sweep_program}},
  };
  return table;
}

namespace {

const Program& program_of(const std::string& name) {
  const auto found = programs().find(name);
  if (found != programs().end()) return found->second;
  std::string names;
  for (const auto& entry : programs()) names += (names.empty() ? "" : ", ") + entry.first;
  throw DerivationError("no program '" + name + "'; there are " + names);
}

}  // namespace

std::vector<double> derive(const std::string& program, const Json& arguments) {
  return program_of(program).run(arguments);
}

std::vector<std::string> prove(const std::string& program, const Json& arguments) {
  const Program& found = program_of(program);
  if (!found.prove) throw DerivationError("the program '" + program + "' proves nothing");
  return found.prove(arguments);
}

}  // namespace trammel::references
