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
      {"annular-membrane", {annular_membrane_program}},
      {"assembly-modes", {assembly_modes_program}},
      {"becks-column", {becks_column_program}},
      {"column-buckling", {column_buckling_program}},
      {"deep-beam-response", {deep_beam_program}},
      {"elastic-chain", {elastic_chain_program}},
      {"elastica-column", {elastica_column_program}},
      {"elastica-tip-force", {elastica_tip_force_program}},
      {"exponential-beam", {exponential_beam_program}},
      {"parallelogram-chain", {parallelogram_chain_program}},
      {"pendulum", {pendulum_program}},
      {"rotating-beam-frequencies", {rotating_beam_frequencies_program}},
      {"rotating-beam-roots", {rotating_beam_roots_program}},
      {"run-up", {run_up_program}},
      {"tapered-beam", {tapered_beam_program}},
      {"beam-frequencies", {beam_frequencies_program}},
      {"beam-roots", {beam_roots_program, prove_beam_roots}},
      {"beam-share", {beam_modal_mass_program}},
      {"frame-buckling", {frame_buckling_program}},
      {"frame-count", {frame_count_program}},
      {"frame-frequencies", {frame_frequencies_program, prove_frame_frequencies}},
      {"frame-frequency-sensitivity", {frame_sensitivity_program}},
      {"frame-statics", {frame_statics_program}},
      {"grnn", {grnn_program}},
      {"manipulator-grnn", {manipulator_grnn_program}},
      {"manipulator-motion", {manipulator_motion_program}},
      {"manipulator-torques", {manipulator_torques_program}},
      {"moving-links", {moving_links_program}},
      {"moving-platform", {moving_platform_program}},
      {"wedge-exponent", {wedge_exponent_program}},
      {"formula", {formula_program}},
      {"swept", {parameter_sweep_program}},
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
