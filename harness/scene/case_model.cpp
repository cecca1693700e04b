#include "harness/scene/case_model.h"

#include <map>
#include <set>

#include "harness/base/text.h"
#include "harness/readers/model_reader.h"
#include "harness/scene/rethrow_as_input.h"
#include "solver/large/large_motion_model.h"
#include "solver/linear/validate.h"
#include "solver/manipulator/manipulator.h"
#include "solver/manipulator/trajectory.h"
#include "solver/model/model.h"

namespace trammel::harness {
namespace {

template <class T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// Returns true if the text contains the label of a part as a complete word.
bool mentions_part_label(const std::string& text, const std::string& label) {
  for (auto at = text.find(label); at != std::string::npos; at = text.find(label, at + 1)) {
    const std::size_t end = at + label.size();
    if (end == text.size() || std::strchr(" ,:;)", text[end]) != nullptr) return true;
  }
  return false;
}

/// Names of model parts, as they occur in names of quantities. Two parts with the same name would
/// overwrite each other's quantities.
class PartNames {
 public:
  /// @throws InputError  if another part has this name. The message contains both JSON pointers.
  void claim(const std::string& name, const JsonView& place) {
    const auto [other, is_new] = pointers_.emplace(name, place.pointer());
    if (is_new) return;
    throw place.error("two parts have the name '" + printable(name) +
                      "' in quantities; expected different names (the other part is " +
                      other->second + ")");
  }

 private:
  std::map<std::string, std::string> pointers_;
};

/// @param bare  model of the manipulator alone, without the other parts of the case
void check_part_names(const JsonView& model, const solver::Model& bare) {
  PartNames names;
  names.claim("total", model);  // "total" denotes the sum over all parts
  if (const auto manipulator = model.find("manipulator")) {
    names.claim("platform", *manipulator);
    for (const solver::Member& member : bare.members) names.claim(member.name, *manipulator);
    for (const solver::Plate& plate : bare.plates)
      if (plate.name != "platform") names.claim(plate.name, *manipulator);
  }
  std::set<std::string> loaded;  // several point masses of a node share a name
  for (const auto& [name, place] : model.entries("point_masses"))
    if (loaded.insert(place.text("node")).second) names.claim("at-" + place.text("node"), place);
  const auto all = model.get<solver::Index>("elements", 1);
  for (const auto& [name, place] : model.entries("members")) {
    for (const char* suffix : {"", ".start", ".end"}) names.claim(name + suffix, place);
    if (!place.has("arc_center_m") && !place.has("restrained_motions")) continue;
    const auto count = place.get<solver::Index>("elements", all);
    for (solver::Index i = 1; i <= count; ++i) names.claim(name + "." + std::to_string(i), place);
  }
  for (const auto& [name, place] : model.entries("plates")) names.claim(name, place);
}

}  // namespace

CaseModel read_case_model(const Document& document) {
  const JsonView root(document);
  if (!root.has("model")) throw root.error("this analysis requires the key 'model'");
  const JsonView model = root["model"];
  CaseModel case_model;
  if (model.has("manipulator")) {
    if (model.has("elements") && !model.has("members"))
      throw model["elements"].error(
          "the model has no 'members'; the elements of links are set in /model/manipulator/links");
    case_model.manipulator = read_manipulator(model["manipulator"]);
    PlatformMotion motion = read_platform_motion(model, case_model.manipulator->geometry);
    case_model.path = std::move(motion.path);
    case_model.motion = std::move(motion.points);
  } else {
    for (const char* key : {"pose", "trajectory"})
      if (model.has(key)) throw model[key].error("this key requires 'manipulator'");
    if (!model.has("nodes") || model["nodes"].size() == 0)
      throw model.error("the model is empty; expected 'manipulator' or 'nodes'");
  }
  rethrow_as_input_error(document, [&] {
    const solver::Model bare =
        case_model.manipulator
            ? solver::build_manipulator(*case_model.manipulator, case_model.motion.front().pose)
            : solver::Model();
    check_part_names(model, bare);
    Structure structure = read_structure(model, bare.nodes);
    case_model.structure = std::move(structure.model);
    case_model.joint_elements = std::move(structure.joints);
  });
  return case_model;
}

solver::Model build_model(const CaseModel& case_model, std::size_t step) {
  solver::Model model = build_without_joint_elements(case_model, step);
  for (const solver::large_motion::Slider& slider : case_model.joint_elements.sliders)
    solver::add_small_motion_slider(model, slider);
  const bool only_large = !case_model.joint_elements.line_springs.empty() ||
                          !case_model.joint_elements.follower_loads.empty();
  if (only_large)
    throw solver::ModelError(
        "line springs and follower loads require the analysis large-statics or large-motion");
  return model;
}

solver::Model build_without_joint_elements(const CaseModel& case_model, std::size_t step) {
  if (!case_model.manipulator)
    return solver::restrict_effects(case_model.structure, case_model.effects);
  solver::Model model = solver::build_manipulator(
      solver::restrict_effects(*case_model.manipulator, case_model.effects),
      case_model.motion.at(step).pose);
  const auto plates = static_cast<solver::Index>(model.plates.size());
  for (solver::Triangle triangle : case_model.structure.triangles) {
    triangle.plate += plates;
    model.triangles.push_back(triangle);
  }
  append(model.nodes, case_model.structure.nodes);
  append(model.members, case_model.structure.members);
  append(model.plates, case_model.structure.plates);
  append(model.rigid_bodies, case_model.structure.rigid_bodies);
  append(model.masses, case_model.structure.masses);
  append(model.springs, case_model.structure.springs);
  append(model.supports, case_model.structure.supports);
  append(model.constraints, case_model.structure.constraints);
  append(model.loads, case_model.structure.loads);
  for (solver::EdgeLoad load : case_model.structure.edge_loads) {
    load.plate += plates;
    model.edge_loads.push_back(load);
  }
  model.gravity = case_model.structure.gravity;
  return solver::restrict_effects(std::move(model), case_model.effects);
}

InputError to_input_error(const Document& document, const solver::ModelError& error) {
  const std::string text = error.what(), message = "the model is invalid: " + text;
  const JsonView model = JsonView(document)["model"];
  const JsonView analysis = JsonView(document)["analysis"].entries().front().second;
  for (const auto& [kind, parts] : {std::pair("drive", analysis.entries("drives")),
                                    {"line spring", model.entries("axial_springs")},
                                    {"slider", model.entries("sliders")},
                                    {"rigid body", model.entries("rigid_bodies")},
                                    {"member", model.entries("members")},
                                    {"support", model.entries("supports")},
                                    {"plate", model.entries("plates")},
                                    {"spring", model.entries("springs")},
                                    {"node", model.entries("nodes")}}) {
    for (const auto& [name, part] : parts)
      if (mentions_part_label(text, solver::part_label(kind, name, 0))) return part.error(message);
  }
  if (text.rfind("drive ", 0) == 0 && analysis.has("track"))
    return analysis["track"].error(message);
  const bool of_path = dynamic_cast<const solver::PathError*>(&error) != nullptr;
  for (const char* key : {"trajectory", "pose"})
    if (of_path && model.has(key)) return model[key].error(message);
  return (model.has("manipulator") ? model["manipulator"] : model).error(message);
}

}  // namespace trammel::harness
