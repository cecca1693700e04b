#include "references/programs/program.h"

#include <regex>

#include "references/beams/programs.h"
#include "references/frames/unit_load.h"
#include "references/frames/wittrick_williams.h"
#include "references/manipulator/programs.h"
#include "references/numerics/expression.h"

namespace trammel::references {

namespace {

Json replace_argument_value(Json arguments, const std::vector<std::string>& pointers,
                            const Json& value, const Arguments& where) {
  for (const std::string& pointer : pointers) {
    try {
      arguments.at(Json::json_pointer(pointer)) = value;
    } catch (const Json::exception&) {
      where.fail("pointers", "expected pointers to values of the arguments, not '" + pointer + "'");
    }
  }
  return arguments;
}

/// Returns the names of the arguments of a program: the words of its line "arguments:" in
/// programs.txt, without the remarks in parentheses.
std::vector<std::string> argument_names(const std::string& program) {
  static const std::regex remark(R"(\([^()]*\))"), name(R"(\w+)");
  const std::string label = "    arguments: ", text = "\n" + embedded_text("programs.txt");
  const std::size_t from = text.find(label, text.find("\n" + program + "\n")) + label.size();
  const auto line = std::regex_replace(text.substr(from, text.find('\n', from) - from), remark, "");
  return {std::sregex_token_iterator(line.begin(), line.end(), name), {}};
}

const Program& program_with_name(const std::string& name) {
  const auto found = programs().find(name);
  if (found != programs().end()) return found->second;
  std::string names;
  for (const auto& entry : programs()) names += (names.empty() ? "" : ", ") + entry.first;
  throw DerivationError("no program '" + name + "'; expected one of " + names);
}

std::vector<Real> run_program(const std::string& program, const Json& arguments) {
  return program_with_name(program).run(Arguments(arguments, "", argument_names(program)));
}

/// Runs another program at each value of a parameter, for the exact results of a parameter study.
/// Arguments: program, arguments, pointers (JSON pointers into the arguments) and values, or
/// patches (merge patches of the arguments).
/// @throws DerivationError  if the arguments have no value at a pointer.
std::vector<Real> parameter_sweep_program(const Arguments& arguments) {
  const std::string program = arguments.text("program");
  std::vector<Json> levels;
  if (arguments.has("patches")) {
    for (const Json& patch : arguments["patches"]) {
      levels.push_back(arguments["arguments"]);
      levels.back().merge_patch(patch);
    }
  } else {
    const std::vector<std::string> pointers = arguments.texts("pointers");
    for (const Json& value : arguments["values"])
      levels.push_back(replace_argument_value(arguments["arguments"], pointers, value, arguments));
  }
  std::vector<Real> values;
  for (const Json& level : levels) {
    const std::vector<Real> found = run_program(program, level);
    values.insert(values.end(), found.begin(), found.end());
  }
  return values;
}

}  // namespace

const std::map<std::string, Program>& programs() {
  static const std::map<std::string, Program> table = {
      {"annular-membrane", {annular_plate_inplane_program}},
      {"assembly-modes", {assembly_modes_program}},
      {"becks-column", {becks_column_program}},
      {"column-buckling", {column_buckling_program}},
      {"deep-beam-response", {forced_timoshenko_beam_program}},
      {"elastic-chain", {elastic_chain_program}},
      {"elastica-column", {elastica_column_program}},
      {"elastica-tip-force", {elastica_tip_force_program}},
      {"exponential-beam", {exponential_beam_program}},
      {"parallelogram-chain", {parallelogram_chain_program}},
      {"pendulum", {pendulum_program}},
      {"rotating-beam-frequencies", {rotating_beam_frequencies_program}},
      {"rotating-beam-roots", {rotating_beam_roots_program}},
      {"run-up", {rotor_run_up_program}},
      {"tapered-beam", {tapered_beam_program}},
      {"beam-frequencies", {beam_frequencies_program}},
      {"beam-roots", {beam_roots_program, prove_beam_roots}},
      {"beam-share", {beam_modal_mass_program}},
      {"frame-buckling", {frame_buckling_program}},
      {"frame-count", {frame_frequency_count_program}},
      {"frame-frequencies", {frame_frequencies_program, prove_frame_frequencies}},
      {"frame-frequency-sensitivity", {frame_frequency_sensitivity_program}},
      {"frame-statics", {frame_statics_program}},
      {"grnn", {regression_network_program}},
      {"manipulator-grnn", {manipulator_grnn_program}},
      {"manipulator-motion", {manipulator_motion_program}},
      {"manipulator-torques", {manipulator_torques_program}},
      {"moving-links", {link_vibration_program}},
      {"moving-platform", {platform_vibration_program}},
      {"wedge-exponent", {wedge_exponent_program}},
      {"formula", {formula_program}},
      {"swept", {parameter_sweep_program}},
  };
  return table;
}

std::vector<double> derive_values(const std::string& program, const Json& arguments) {
  const std::vector<Real> values = run_program(program, arguments);
  std::vector<double> rounded;
  for (const Real& value : values) rounded.push_back(static_cast<double>(value));
  return rounded;
}

std::vector<std::string> prove(const std::string& program, const Json& arguments) {
  const Program& found = program_with_name(program);
  if (!found.prove) throw DerivationError("the program '" + program + "' has no proof");
  return found.prove(Arguments(arguments, "", argument_names(program)));
}

}  // namespace trammel::references
