#include "harness/scene/outputs.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "harness/base/text.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

struct OutputKeyword {
  const char* name;
  Output::Kind kind;
  solver::Index component;
};

constexpr std::array<OutputKeyword, 13> kOutputKeywords = {{
    {"displacement_x_m", Output::Kind::displacement, 0},
    {"displacement_y_m", Output::Kind::displacement, 1},
    {"rotation_rad", Output::Kind::displacement, 2},
    {"velocity_x_m_per_s", Output::Kind::velocity, 0},
    {"velocity_y_m_per_s", Output::Kind::velocity, 1},
    {"angular_velocity_rad_per_s", Output::Kind::velocity, 2},
    {"acceleration_x_m_per_s2", Output::Kind::acceleration, 0},
    {"acceleration_y_m_per_s2", Output::Kind::acceleration, 1},
    {"axial_force_N", Output::Kind::resultant, 0},
    {"shear_force_N", Output::Kind::resultant, 1},
    {"bending_moment_N_m", Output::Kind::resultant, 2},
    {"bending_stress_Pa", Output::Kind::bending_stress, 2},
    {"stress_Pa", Output::Kind::stress, 0},
}};

OutputKeyword find_keyword(const JsonView& place, const std::string& head) {
  std::vector<std::string> all;
  for (const OutputKeyword& keyword : kOutputKeywords) {
    if (head == keyword.name) return keyword;
    all.emplace_back(keyword.name);
  }
  throw place.error(
      "expected a quantity with the part that it is of, as displacement_y_m:A (got '" +
      printable(place.get<std::string>()) + "')" + did_you_mean(head, all));
}

template <class Parts>
solver::Index find_part(const JsonView& place, const Parts& parts, const std::string& name,
                        const char* what) {
  std::vector<std::string> all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!name.empty() && parts[i].name == name) return static_cast<solver::Index>(i);
    all.push_back(parts[i].name);
  }
  throw place.error(std::string("expected the name of a ") + what + " after the colon (got '" +
                    printable(name) + "')" + did_you_mean(name, all));
}

Output read_output(const JsonView& place, const solver::Model& model) {
  Output output;
  output.name = place.get<std::string>();
  const std::size_t colon = output.name.find(':');
  const OutputKeyword keyword = find_keyword(place, output.name.substr(0, colon));
  output.kind = keyword.kind;
  output.component = keyword.component;
  std::string part = colon == std::string::npos ? "" : output.name.substr(colon + 1);
  if (!output.needs_forces()) {
    output.item = find_part(place, model.nodes, part, "node");
    return output;
  }
  if (output.kind != Output::Kind::stress) {
    const std::size_t dot = part.rfind('.');
    const std::string end = dot == std::string::npos ? "" : part.substr(dot + 1);
    if (end != "start" && end != "end") {
      throw place.error("expected an end of the member, as '" + printable(part) + ".start'");
    }
    output.end = end == "start" ? 0 : 1;
    part.resize(dot);
  }
  output.item = find_part(place, model.members, part, "member");
  const solver::Member& member = model.members[solver::to_size(output.item)];
  const bool has_depth =
      member.section.section_modulus > 0 && member.end_section.section_modulus > 0;
  if (output.kind == Output::Kind::bending_stress && !has_depth) {
    throw place.error(
        "expected a member whose sections have a depth: a shape, or 'half_depth_m' "
        "with 'area_m2'");
  }
  return output;
}

/// N, V or M; or M over the section modulus.
double end_force(const Output& output, const solver::Model& model, const Eigen::MatrixX3d& start,
                 const Eigen::MatrixX3d& end) {
  const double force = (output.end == 0 ? start : end)(output.item, output.component);
  if (output.kind == Output::Kind::resultant) return force;
  const solver::Member& member = model.members[solver::to_size(output.item)];
  return force / (output.end == 0 ? member.section : member.end_section).section_modulus;
}

}  // namespace

bool needs_forces(const std::vector<Output>& outputs) {
  return std::ranges::any_of(outputs, &Output::needs_forces);
}

std::vector<Output> read_outputs(const JsonView& outputs, const solver::Model& model) {
  std::vector<Output> read;
  for (const auto& entry : outputs.entries()) read.push_back(read_output(entry.second, model));
  return read;
}

double value_of(const Output& output, const solver::Model& model, const MovingState& state) {
  switch (output.kind) {
    case Output::Kind::displacement:
      return state.displacement(output.item, output.component);
    case Output::Kind::velocity:
      return state.velocity(output.item, output.component);
    case Output::Kind::acceleration:
      return state.acceleration(output.item, output.component);
    case Output::Kind::stress:
      return state.forces.member_stress[output.item];
    default:
      return end_force(output, model, state.forces.resultant_start, state.forces.resultant_end);
  }
}

double amplitude_of(const Output& output, const solver::Model& model,
                    const solver::HarmonicAmplitudes& amplitudes, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  switch (output.kind) {
    case Output::Kind::displacement:
      return amplitudes.displacement(output.item, output.component);
    case Output::Kind::velocity:
      return omega * amplitudes.displacement(output.item, output.component);
    case Output::Kind::acceleration:
      return omega * omega * amplitudes.displacement(output.item, output.component);
    case Output::Kind::stress:
      return amplitudes.member_stress[output.item];
    default:
      return end_force(output, model, amplitudes.resultant_start, amplitudes.resultant_end);
  }
}

}  // namespace trammel::harness
