#include "harness/export/exported_case.h"

#include <array>
#include <set>

#include "harness/analysis/analysis.h"
#include "harness/analysis/registry.h"
#include "harness/base/environment.h"
#include "harness/base/find_or_add.h"
#include "harness/base/quantity.h"
#include "harness/base/text.h"
#include "harness/input/check.h"
#include "harness/readers/field_reader.h"
#include "harness/readers/option_reader.h"
#include "harness/results/quantity_definitions.h"
#include "harness/scene/rethrow_as_input.h"
#include "harness/scene/tracking.h"
#include "solver/manipulator/rigid_dynamics.h"
#include "trammel_build.h"

namespace trammel::harness {
namespace {

using solver::Effect;

JsonView analysis_view(const Document& document) {
  return JsonView(document)["analysis"][analysis_kind(document)];
}

/// Returns true for analyses of the manipulator along a path. Their export contains the manipulator
/// unchanged, and a description of its bodies and joints.
bool exports_mechanism(const std::string& kind) {
  return kind == "kinematics" || kind == "inverse-dynamics" || kind == "forward-dynamics" ||
         kind == "elastodynamics";
}

/// Returns true for the analysis of a neural network whose samples are stated in the case. Such a
/// case has no model.
bool has_stated_samples(const Document& document) {
  return analysis_kind(document) == "grnn" && analysis_view(document).has("samples");
}

void require_exportable_case(const Document& document) {
  constexpr std::array kinds = {"statics",      "buckling", "modes",    "large-statics",
                                "large-motion", "harmonic", "transient"};
  const JsonView place = analysis_view(document);
  if (!contains(kinds, analysis_kind(document)))
    throw place.error("the analysis " + analysis_kind(document) +
                      " cannot be exported; expected, for example, statics or modes");
  const JsonView root(document);
  if (root.has("model") && root["model"].has("trajectory"))
    throw root["model"]["trajectory"].error("a trajectory cannot be exported; expected 'pose'");
  if (place.has("track")) throw place["track"].error("'track' is not exported; expected 'drives'");
}

/// Returns the JSON object of the analysis, with keys that switch on exactly the effects `chosen`.
Json analysis_with_stated_effects(const Document& document, solver::Effects chosen) {
  Json analysis = document.value().at("analysis");
  if (!document.value().contains("effects")) return analysis;
  const JsonView place = analysis_view(document);
  const bool kept = !place.has("rotating") || chosen.has(Effect::geometric_stiffening);
  if (chosen.has(Effect::large_displacement) || !kept)
    throw JsonView(document)["effects"].error(
        "large displacement, and a rotating frame without geometric stiffening, cannot be "
        "exported, because no key of the analysis expresses them");
  if (!chosen.has(Effect::damping))
    for (const char* key : {"damping", "mass_damping_per_s", "strain_rate_damping_s"})
      analysis[analysis_kind(document)].erase(key);
  for (const EffectKey& key : find_analysis(analysis_kind(document)).effects->keys(place)) {
    JsonPointer at = JsonPointer() / analysis_kind(document);
    for (const char* word : key.place) at /= word;
    analysis[at] = chosen.has(key.effect);
  }
  return analysis;
}

WrittenNames written_names(const Document& document) {
  const JsonView model = JsonView(document)["model"];
  WrittenNames names;
  for (const auto& [name, place] : model.entries("materials"))
    names.materials.emplace_back(name, read_material(place));
  for (const char* key : {"material", "platform_material"}) {
    if (model.has("manipulator") && model["manipulator"].has(key))
      names.materials.emplace_back(std::string("manipulator-") + key,
                                   read_material(model["manipulator"][key]));
  }
  for (const auto& [name, place] : model.entries("loads"))
    if (place.has("node")) names.loads.push_back(name);
  return names;
}

/// Returns the parts that have quantities in the case but do not keep their name in the exported
/// case.
std::set<std::string> renamed_parts(const Document& document, const solver::Model& model) {
  std::set<std::string> lost;
  if (!JsonView(document).has("model")) return lost;
  for (const auto& edge : JsonView(document)["model"].entries("edges")) lost.insert(edge.first);
  for (const solver::Member& member : model.members)
    if (is_tapered(member))
      lost.insert({member.name, member.name + ".start", member.name + ".end"});
  return lost;
}

/// Returns the number of values of a quantity, or null if this number is unknown before the
/// computation.
Json length_of_quantity(const Document& document, const std::string& name) {
  const JsonView place = analysis_view(document);
  if (analysis_kind(document) == "statics") return 1;
  const bool is_list = analysis_kind(document) == "modes" && name == "frequency_Hz";
  return is_list && !place.has("rotating") ? place["count"].json() : Json(nullptr);
}

/// Returns the checks of this variant, and the checks that compare other variants with this
/// variant.
std::vector<Check> checks_of_variant(const Document& document, const std::string& variant,
                                     const Case& given) {
  const std::vector<std::string> variants = given.variants();
  std::vector<Check> checks = read_checks(document, variant, variants);
  for (const std::string& other : variants) {
    if (other == variant) continue;
    for (Check& check : read_checks(case_with_chosen_patches(given, {other}), other, variants))
      if (check.against_variant == variant) checks.push_back(std::move(check));
  }
  return checks;
}

Json export_quantities(const Document& document, const std::vector<Check>& checks,
                       const solver::Model& model) {
  const std::set<std::string> lost = renamed_parts(document, model);
  Json asked = Json::array();
  std::set<std::string> seen = {""};
  for (const Check& check : checks)
    for (const std::string& name : {check.quantity, check.against_quantity}) {
      if (!seen.insert(name).second) continue;
      const std::size_t colon = name.find(':');
      if (colon != std::string::npos && lost.count(name.substr(colon + 1)) > 0)
        throw document.error(check.pointer,
                             "the quantity '" + name +
                                 "' belongs to an edge or a tapered member, which is not exported");
      const auto* known = results::find_quantity_definition(name, analysis_kind(document));
      asked.push_back({{"name", name},
                       {"unit", unit_of(name)},
                       {"length", length_of_quantity(document, name)},
                       {"about", known == nullptr ? "" : known->meaning}});
    }
  return asked;
}

Json plain_model(const Document& document, const ExportedScene& scene) {
  return rethrow_as_input_error(
      document, [&] { return model_json(scene.model, scene.joints, written_names(document)); });
}

Json body(double mass, double inertia, const solver::BodyMotion& start) {
  return {{"mass_kg", mass},
          {"inertia_kg_m2", inertia},
          {"center_m", {start.position.x(), start.position.y()}},
          {"angle_rad", start.angle}};
}

Json joint(const std::string& first, const std::string& second, const Eigen::Vector2d& at) {
  return {{"bodies", {first, second}}, {"position_m", {at.x(), at.y()}}};
}

Json row(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// Describes the rigid manipulator at the first point of the path, and the path of the platform
/// point P as a table over time. Bodies have mass, inertia, center and angle. Joints have two
/// bodies and a position.
Json mechanism_json(const CaseModel& case_model) {
  const solver::RigidManipulator rigid = solver::rigid_manipulator(*case_model.manipulator);
  const solver::TrajectoryPoint& first = case_model.motion.front();
  const solver::InverseDynamics start = solver::inverse_dynamics(rigid, first);
  const solver::Posture posture = solver::inverse_kinematics(rigid.geometry, first.pose);
  Json bodies = Json::object(), joints = Json::object();
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i + 1);
    const std::string proximal = "A" + n + "-B" + n, distal = "B" + n + "-C" + n;
    bodies[proximal] = body(rigid.proximal[i].mass, rigid.proximal[i].inertia, start.bodies[i]);
    bodies[distal] = body(rigid.distal[i].mass, rigid.distal[i].inertia, start.bodies[3 + i]);
    joints["A" + n] = joint("ground", proximal, rigid.geometry.base[i]);
    joints["B" + n] = joint(proximal, distal, posture.B[i]);
    joints["C" + n] = joint(distal, "platform", posture.C[i]);
  }
  bodies["platform"] = body(rigid.platform.mass, rigid.platform.inertia, start.bodies[6]);
  Json path = {{"time_s", Json::array()}};
  for (const solver::TrajectoryPoint& point : case_model.motion) {
    path["time_s"].push_back(point.time);
    path["pose_m_rad"].push_back(row({point.pose.x, point.pose.y, point.pose.phi}));
    path["velocity_per_s"].push_back(row(point.velocity));
    path["acceleration_per_s2"].push_back(row(point.acceleration));
  }
  return {{"bodies", bodies}, {"joints", joints}, {"path", path}};
}

/// Returns the bodies, joints and path of the mechanism. For elastodynamics, the result includes
/// the elastic model at the first point of the path.
Json mechanism_of_case(const Document& document) {
  const CaseModel case_model = read_case_model(document);
  if (!case_model.manipulator) throw analysis_view(document).error("expected a 'manipulator'");
  Json mechanism = mechanism_json(case_model);
  if (analysis_kind(document) == "elastodynamics") {
    mechanism["elastic_model"] = rethrow_as_input_error(document, [&] {
      return plain_model(document,
                         {build_without_joint_elements(case_model, 0), case_model.joint_elements});
    });
  }
  return mechanism;
}

/// Lists the named nodes of a large motion under the key "nodes" if this key is absent. Without
/// this list, the exported case would also record nodes that have no name in the original case.
void list_recorded_nodes(const solver::Model& model, Json& analysis) {
  if (!analysis.contains("large-motion") || analysis["large-motion"].contains("nodes")) return;
  Json& names = analysis["large-motion"]["nodes"] = Json::array();
  for (const solver::Node& node : model.nodes)
    if (!node.name.empty()) names.push_back(node.name);
}

}  // namespace

Document case_with_chosen_patches(const Case& given, const ExportChoice& choice) {
  Document document = patched(given, choice.variant);
  if (!choice.level) return document;
  std::vector<std::string> names;
  for (const auto& sweep : JsonView(document).entries("sweeps")) names.push_back(sweep.first);
  const std::string name = choice.sweep.empty() && names.size() == 1 ? names[0] : choice.sweep;
  if (!contains(names, name))
    throw document.error("/sweeps", "expected the name of a sweep (got '" + printable(name) +
                                        "'; the case has " +
                                        (names.empty() ? "none" : join(names, "and")) + ")");
  std::vector<Level> all = sweep_levels(document, name);
  if (*choice.level >= all.size())
    throw document.error("/sweeps/" + name, "expected a sweep level from 0 to " +
                                                std::to_string(all.size() - 1) + " (got " +
                                                std::to_string(*choice.level) + ")");
  return all[*choice.level].document;
}

ExportedScene exported_scene(const Document& document) {
  require_exportable_case(document);
  CaseModel case_model = read_case_model(document);
  return rethrow_as_input_error(document, [&] {
    if (document.value().contains("effects"))
      case_model.effects = choose_effects(document, case_model).chosen;
    ExportedScene scene{build_without_joint_elements(case_model, 0), case_model.joint_elements,
                        case_model.effects};
    if (analysis_kind(document).starts_with("large-")) {
      const JsonView place = analysis_view(document);
      solver::large_motion::LargeMotionModel driven = scene.joints;
      read_prescribed_motions(place, scene.model, driven);
      release_driven_actuators(place, case_model, driven, scene.model);
    }
    return scene;
  });
}

Json export_case(const Case& given, const ExportChoice& choice) {
  const Document document = case_with_chosen_patches(given, choice);
  const Json& whole = document.value();
  Json exported = {{"id", given.id()}, {"title", given.title()}};
  if (whole.contains("timeout_s")) exported["timeout_s"] = whole["timeout_s"];
  const bool of_mechanism = exports_mechanism(analysis_kind(document));
  ExportedScene scene;
  if (of_mechanism || has_stated_samples(document)) {
    for (const char* key : {"model", "analysis", "effects"})
      if (whole.contains(key)) exported[key] = whole[key];
  } else {
    scene = exported_scene(document);
    exported["model"] = plain_model(document, scene);
    exported["analysis"] = analysis_with_stated_effects(document, scene.effects);
    list_recorded_nodes(scene.model, exported["analysis"]);
  }
  const bool is_base = choice.variant == kBaseVariant;
  Json& about = exported["export"] = {
      {"case", given.id()},
      {"variant", is_base ? Json(nullptr) : Json(choice.variant)},
      {"level", choice.level ? Json(*choice.level) : Json(nullptr)},
      {"hash", content_hash(whole.dump())},
      {"trammel", TRAMMEL_VERSION},
      {"quantities", export_quantities(document, checks_of_variant(document, choice.variant, given),
                                       scene.model)}};
  if (!choice.sweep.empty()) about["sweep"] = choice.sweep;
  if (of_mechanism) about["mechanism"] = mechanism_of_case(document);
  return exported;
}

}  // namespace trammel::harness
