#include "harness/readers/discretization.h"

#include <cmath>
#include <numbers>

#include "harness/input/case.h"

namespace trammel::harness {
namespace {

// Central angle of the arc that one straight element replaces [deg]. At this angle, the straight
// elements change natural frequencies by 0.1 %.
constexpr double kDegreesOfElement = 7.5;
constexpr double kToleranceRatio = 10;

const Json* find(const Json& document, const std::string& pointer) {
  const JsonPointer at(pointer);
  return document.contains(at) ? &document.at(at) : nullptr;
}

double arc_angle_of_member(const Json& model, const Json& member) {
  const auto from_center = [&](std::size_t end) {
    const Json& node = model.at("nodes").at(member.at("nodes")[end].get<std::string>());
    const Json& center = member.at("arc_center_m");
    return std::atan2(node[1].get<double>() - center[1].get<double>(),
                      node[0].get<double>() - center[0].get<double>());
  };
  const double turn = from_center(1) - from_center(0);
  return turn > 0 ? turn : turn + 2 * std::numbers::pi;
}

/// Returns true for a bar, which must remain a single element: without bending stiffness, nodes
/// inside the bar could move sideways freely.
bool is_bar(const Json& model, const Json& member) {
  const Json* section = find(model, "/sections/" + member.value("section", ""));
  return section != nullptr && section->value("second_moment_m4", 1.0) == 0 &&
         !member.contains("restrained_motions");
}

/// Writes twice or half a number of elements into a patch.
/// @returns false if an odd number would be halved
bool set_refined_count(Json& place, solver::Index count, Refine refine) {
  if (refine == Refine::coarser && count % 2 != 0) return false;
  place = refine == Refine::finer ? 2 * count : count / 2;
  return true;
}

bool refine_manipulator(const Document& document, Refine refine, Json& patch) {
  const Json& manipulator = document.value()["model"]["manipulator"];
  const Json& links = manipulator["links"];
  Json& refined_links = patch["manipulator"]["links"];
  bool all = set_refined_count(refined_links["elements"],
                               links.value("elements", default_element_count(document)), refine);
  for (const char* kind : {"proximal", "distal"}) {
    const Json* own = find(links, std::string("/") + kind + "/elements");
    if (own != nullptr)
      all = set_refined_count(refined_links[kind]["elements"], own->get<solver::Index>(), refine) &&
            all;
  }
  const Json& platform = manipulator["platform"];
  if (platform["kind"] != "triangles") return all;
  const int level = platform.value("refinements", 0) + (refine == Refine::finer ? 1 : -1);
  patch["manipulator"]["platform"]["refinements"] = level;
  return all && level >= 0;
}

}  // namespace

std::string inner_analysis_kind(const Document& document) {
  const Json& analysis = document.value().at("analysis");
  const std::string kind = analysis.begin().key();
  return kind == "study" ? analysis["study"]["analysis"].begin().key() : kind;
}

std::string analysis_pointer(const Document& document) {
  const bool is_study = document.value().at("analysis").contains("study");
  return std::string("/analysis/") + (is_study ? "study/analysis/" : "") +
         inner_analysis_kind(document);
}

solver::Index default_element_count(const Document& document) {
  const Json* stated = find(document.value(), "/model/elements");
  if (stated != nullptr) return stated->get<solver::Index>();
  const std::string kind = inner_analysis_kind(document);
  const Json* second_order = find(document.value(), analysis_pointer(document) + "/second_order");
  const bool is_linear = second_order == nullptr || !second_order->get<bool>();
  if (kind == "large-statics" || kind == "properties") return 1;
  return kind == "statics" && is_linear ? 1 : 4;
}

solver::Index element_count_of(const Document& document, const std::string& name) {
  constexpr solver::Index kLeastOfArc = 4, kTapered = 8;
  const Json& model = document.value()["model"];
  const Json& member = model["members"][name];
  if (member.contains("elements")) return member["elements"].get<solver::Index>();
  if (model.contains("elements")) return default_element_count(document);
  if (is_bar(model, member)) return 1;
  if (member.contains("arc_center_m")) {
    const double degrees = arc_angle_of_member(model, member) * 180 / std::numbers::pi;
    return std::max(kLeastOfArc, static_cast<solver::Index>(
                                     std::ceil(degrees / kDegreesOfElement * (1 - 1e-12))));
  }
  return member.contains("end_section") ? kTapered : default_element_count(document);
}

std::optional<Json> mesh_patch(const Document& document, Refine refine) {
  if (!document.value().contains("model")) return std::nullopt;
  const Json& model = document.value()["model"];
  Json patch = Json::object();
  bool all = true;
  if (model.contains("members"))
    for (const auto& [name, member] : model["members"].items())
      if (!is_bar(model, member) || element_count_of(document, name) > 1)
        all = set_refined_count(patch["members"][name]["elements"],
                                element_count_of(document, name), refine) &&
              all;
  if (model.contains("plates"))
    for (const auto& [name, plate] : model["plates"].items())
      if (plate.contains("blocks"))
        all = set_refined_count(patch["plates"][name]["divisions"], plate.value("divisions", 1),
                                refine) &&
              all;
  if (model.contains("manipulator")) all = refine_manipulator(document, refine, patch) && all;
  if (patch.empty() || !all) return std::nullopt;
  return Json{{"model", patch}};
}

bool has_step_tolerance(const Document& document) {
  const Json& analysis = document.value().at(JsonPointer(analysis_pointer(document)));
  return analysis.contains("tolerance") || analysis.contains("error_control");
}

bool has_exact_steps(const Document& document) {
  const Json& analysis = document.value().at(JsonPointer(analysis_pointer(document)));
  const Json* inertia = find(analysis, "/effects/elastic_inertia");
  return analysis.value("modal_superposition", false) ||
         (analysis.contains("method") && analysis["method"] == "modal-superposition") ||
         (inner_analysis_kind(document) == "elastodynamics" && inertia != nullptr &&
          *inertia == false);
}

std::optional<Json> time_step_patch(const Document& document, Refine refine, double largest_step) {
  const std::string kind = inner_analysis_kind(document), place = analysis_pointer(document);
  const Json& analysis = document.value().at(JsonPointer(place));
  const double longer = refine == Refine::finer ? 0.5 : 2;
  const double looser = refine == Refine::finer ? 1 / kToleranceRatio : kToleranceRatio;
  Json patch = Json::object();
  if (kind == "forward-dynamics") {
    patch["tolerance"] = looser * analysis.value("tolerance", 1e-10);
  } else if (has_exact_steps(document) || kind == "grnn" ||
             !(analysis.contains("step_s") || has_step_tolerance(document))) {
    return std::nullopt;
  } else if (analysis.contains("tolerance")) {
    patch["tolerance"] = looser * analysis["tolerance"].get<double>();
    if (analysis.contains("output_step_s") && refine == Refine::finer)
      patch["output_step_s"] = longer * analysis["output_step_s"].get<double>();
  } else if (analysis.contains("error_control")) {
    patch["error_control"]["relative"] = looser * analysis["error_control"].value("relative", 1e-4);
    const double step = analysis.value("step_s", largest_step);
    if (step > 0) patch["step_s"] = longer * step;
  } else {
    const double step = longer * analysis["step_s"].get<double>();
    if (kind == "transient" && refine == Refine::coarser && analysis.contains("samples") &&
        step * analysis["samples"].get<double>() >
            (1 + 1e-9) * analysis["duration_s"].get<double>())
      return std::nullopt;  // a step ends at each sample
    patch["step_s"] = step;
    if (analysis.value("output_step_s", step) < step) patch["output_step_s"] = step;
  }
  return patch_setting_value(document.value(), place, patch);
}

std::string mesh_pointer(const Document& document) {
  const Json& model = document.value()["model"];
  if (model.contains("manipulator")) return "/model/manipulator/links/elements";
  return model.contains("members") ? "/model/elements" : "/model/plates";
}

std::string time_step_pointer(const Document& document) {
  const Json& analysis = document.value().at(JsonPointer(analysis_pointer(document)));
  const std::string place = analysis_pointer(document);
  if (analysis.contains("error_control")) return place + "/error_control/relative";
  return place + (analysis.contains("tolerance") ? "/tolerance" : "/step_s");
}

}  // namespace trammel::harness
