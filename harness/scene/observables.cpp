#include "harness/scene/observables.h"

#include <algorithm>
#include <cmath>

#include "harness/base/find_or_add.h"
#include "harness/base/number.h"
#include "harness/base/text.h"
#include "harness/results/quantity_definitions.h"
#include "solver/model/numbers.h"

namespace trammel::harness {
namespace {

using solver::Index;
using solver::Model;
using Of = Observable::Of;
using State = ModelState;

/// Returns the value in one column of a result matrix for a node or member; NaN if the analysis has
/// not computed the matrix.
template <auto matrix, Index component>
double entry(const Model&, const State& state, const ModelPart& part) {
  const Index row = part.items.front();
  return row < (state.*matrix).rows() ? (state.*matrix)(row, component) : kNaN;
}

template <Index component>
double position(const Model& model, const State& state, const ModelPart& part) {
  return model.nodes[solver::to_size(part.items.front())].position[component] +
         state.displacement(part.items.front(), component);
}

double end_rotation(const Model&, const State& state, const ModelPart& part) {
  return state.end_rotation(part.items.front(), part.end);
}

/// Returns the axial force N, shear force V or bending moment M at one end of a member.
template <Index component>
double resultant(const Model&, const State& state, const ModelPart& part) {
  return (part.end == 0 ? state.resultant_start : state.resultant_end)(part.items.front(),
                                                                       component);
}

/// Returns the bending stress M / W at the end of a member, with the sign of M. It is the stress at
/// the fiber to the right, seen from the first to the second node. Returns NaN for a section
/// without a depth.
double bending_stress(const Model& model, const State& state, const ModelPart& part) {
  const solver::Member& member = model.members[solver::to_size(part.items.front())];
  const double modulus = (part.end == 0 ? member.section : member.end_section).section_modulus;
  if (!(modulus > 0 && std::isfinite(modulus))) return kNaN;
  return resultant<2>(model, state, part) / modulus;
}

/// Returns the sum of the reactions of all supports with one name, such as the supports of an edge.
template <Index component>
double reaction(const Model&, const State& state, const ModelPart& part) {
  double sum = state.reaction(part.items.front(), component);
  for (std::size_t i = 1; i < part.items.size(); ++i)
    sum += state.reaction(part.items[i], component);
  return sum;
}

double reaction_moment(const Model& model, const State& state, const ModelPart& part) {
  return part.items.size() == 1 ? reaction<2>(model, state, part) : kNaN;
}

double reaction_magnitude(const Model& model, const State& state, const ModelPart& part) {
  return std::hypot(reaction<0>(model, state, part), reaction<1>(model, state, part));
}

double von_mises_stress(const Model&, const State& state, const ModelPart& part) {
  if (state.triangle_stress.rows() == 0) return kNaN;
  double largest = 0;
  for (const Index triangle : part.items) {
    const Eigen::RowVector3d s = state.triangle_stress.row(triangle);
    largest = solver::nan_max(largest,
                              std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3 * s[2] * s[2]));
  }
  return largest;
}

constexpr auto kObservables = std::to_array<Observable>({
    {"displacement_x_m", Of::node, entry<&State::displacement, 0>},
    {"displacement_y_m", Of::node, entry<&State::displacement, 1>},
    {"rotation_rad", Of::node, entry<&State::displacement, 2>, false, true},
    {"velocity_x_m_per_s", Of::node, entry<&State::velocity, 0>},
    {"velocity_y_m_per_s", Of::node, entry<&State::velocity, 1>},
    {"angular_velocity_rad_per_s", Of::node, entry<&State::velocity, 2>, false, true},
    {"acceleration_x_m_per_s2", Of::node, entry<&State::acceleration, 0>},
    {"acceleration_y_m_per_s2", Of::node, entry<&State::acceleration, 1>},
    {"position_x_m", Of::node, position<0>},
    {"position_y_m", Of::node, position<1>},
    {"relative_x_m", Of::node, entry<&State::relative, 0>, false, true},
    {"relative_y_m", Of::node, entry<&State::relative, 1>, false, true},
    {"relative_rotation_rad", Of::node, entry<&State::relative, 2>, false, true},
    {"steady_displacement_x_m", Of::node, entry<&State::displacement, 0>},
    {"steady_displacement_y_m", Of::node, entry<&State::displacement, 1>},
    {"end_rotation_rad", Of::member_end, end_rotation, false, true},
    {"axial_force_N", Of::member_end, resultant<0>, true},
    {"shear_force_N", Of::member_end, resultant<1>, true},
    {"bending_moment_N_m", Of::member_end, resultant<2>, true},
    {"bending_stress_Pa", Of::member_end, bending_stress, true, true},
    {"stress_Pa", Of::member, entry<&State::member_stress, 0>, true, true},
    {"reaction_x_N", Of::support, reaction<0>, true, true},
    {"reaction_y_N", Of::support, reaction<1>, true, true},
    {"reaction_N", Of::support, reaction_magnitude, true, true},
    {"reaction_moment_N_m", Of::support, reaction_moment, true, true},
    {"stress_xx_Pa", Of::node, entry<&State::node_stress, 0>, true, true},
    {"stress_yy_Pa", Of::node, entry<&State::node_stress, 1>, true, true},
    {"stress_xy_Pa", Of::node, entry<&State::node_stress, 2>, true, true},
    {"von_mises_stress_Pa", Of::plate, von_mises_stress, true, true},
});

/// Returns all named parts of one kind, such as nodes. Nodes and members without a name, such as
/// those inside a plate or a chain of members, are omitted.
std::vector<ModelPart> named_parts_of_model(const Model& model, Of of) {
  std::vector<ModelPart> parts;
  const auto add_all = [&](const auto& all, Index end, const char* suffix) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (!all[i].name.empty())
        parts.push_back({all[i].name + suffix, {static_cast<Index>(i)}, end});
  };
  if (of == Of::node) add_all(model.nodes, 0, "");
  if (of == Of::member) add_all(model.members, 0, "");
  if (of == Of::member_end) {
    add_all(model.members, 0, ".start");
    add_all(model.members, 1, ".end");
  }
  for (std::size_t i = 0; of == Of::support && i < model.supports.size(); ++i) {
    const std::string& name = model.supports[i].name;
    if (name.empty()) continue;
    const auto is_its = [&](const ModelPart& part) { return part.name == name; };
    find_or_add(parts, is_its, {name, {}, 0}).items.push_back(static_cast<Index>(i));
  }
  if (of == Of::plate) {
    for (const solver::Plate& plate : model.plates) parts.push_back({plate.name, {}, 0});
    for (std::size_t i = 0; i < model.triangles.size(); ++i)
      parts[solver::to_size(model.triangles[i].plate)].items.push_back(static_cast<Index>(i));
  }
  return parts;
}

ModelPart find_part(const JsonView& place, const Model& model, Of of, const std::string& name) {
  std::vector<std::string> all;
  for (ModelPart& part : named_parts_of_model(model, of)) {
    if (part.name == name) return std::move(part);
    all.push_back(part.name);
  }
  throw place.error(std::string("expected the name of a ") + (of == Of::node ? "node" : "member") +
                    " after the colon (got '" + printable(name) + "')" + did_you_mean(name, all));
}

/// Returns the observables that an analysis records.
std::vector<const Observable*> observables_of_analysis(const std::string& analysis) {
  std::vector<const Observable*> rows;
  for (const Observable& one : kObservables)
    if (results::find_quantity_definition(one.name, analysis) != nullptr) rows.push_back(&one);
  return rows;
}

Output read_output(const JsonView& place, const Model& model) {
  Output output;
  output.name = place.get<std::string>();
  const std::size_t colon = output.name.find(':');
  const std::string head = output.name.substr(0, colon);
  std::string part = colon == std::string::npos ? "" : output.name.substr(colon + 1);
  std::vector<std::string> heads;
  for (const Observable* one : observables_of_analysis("transient")) {
    if (head == one->name) output.observable = one;
    heads.emplace_back(one->name);
  }
  if (output.observable == nullptr)
    throw place.error(
        "expected a quantity and the name of a part, such as displacement_y_m:A (got '" +
        printable(output.name) + "')" + did_you_mean(head, heads));
  if (output.observable->of != Of::member_end) {
    output.part = find_part(place, model, output.observable->of, part);
    return output;
  }
  const std::size_t dot = part.rfind('.');
  const std::string end = dot == std::string::npos ? "" : part.substr(dot + 1);
  if (end != "start" && end != "end")
    throw place.error("expected an end of the member, such as '" + printable(part) + ".start'");
  output.part = find_part(place, model, Of::member, part.substr(0, dot));
  output.part.end = end == "start" ? 0 : 1;
  const solver::Member& member = model.members[solver::to_size(output.part.items.front())];
  const bool has_depth =
      member.section.section_modulus > 0 && member.end_section.section_modulus > 0;
  if (output.observable->value == bending_stress && !has_depth)
    throw place.error(
        "bending stress requires a section with a depth: 'rectangle', 'circle' or "
        "'half_depth_m'");
  return output;
}

}  // namespace

StateRecorder::StateRecorder(const solver::Model& model, const std::string& analysis,
                             const std::vector<std::string>& without,
                             const std::vector<solver::Index>* nodes)
    : model_(model) {
  const auto is_left_out = [&](Of of, const ModelPart& part) {
    const Index item = part.items.empty() ? -1 : part.items.front();
    return !contains(*nodes, of == Of::support ? model.supports[solver::to_size(item)].node : item);
  };
  for (const Observable* one : observables_of_analysis(analysis)) {
    if (contains(without, one->name)) continue;
    rows_.push_back({one, named_parts_of_model(model, one->of)});
    if (nodes != nullptr) std::erase_if(rows_.back().parts, std::bind_front(is_left_out, one->of));
  }
}

void StateRecorder::record(const ModelState& state, Recorder& record, double displacement_roundoff,
                           double force_roundoff) const {
  for (const auto& [observable, parts] : rows_)
    for (const ModelPart& part : parts) {
      const double value = observable->value(model_, state, part);
      if (observable->is_optional && std::isnan(value)) continue;
      record.add(observable->name, part.name, value,
                 observable->is_force ? force_roundoff : displacement_roundoff);
    }
}

bool needs_forces(const std::vector<Output>& outputs) {
  return std::ranges::any_of(outputs, [](const Output& one) { return one.observable->is_force; });
}

std::vector<Output> read_outputs(const JsonView& outputs, const solver::Model& model) {
  std::vector<Output> read;
  for (const auto& entry : outputs.entries()) read.push_back(read_output(entry.second, model));
  return read;
}

}  // namespace trammel::harness
