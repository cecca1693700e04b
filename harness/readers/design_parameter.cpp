#include "harness/readers/design_parameter.h"

#include <algorithm>
#include <map>

namespace trammel::harness {
namespace {

using Kind = trammel::solver::DesignParameter::Kind;

void choose(const std::string& link, solver::DesignParameter& parameter) {
  const auto limb = static_cast<std::size_t>(link[1] - '1');
  (link[0] == 'A' ? parameter.proximal : parameter.distal)[limb] = true;
}

}  // namespace

solver::DesignParameter read_design_parameter(const JsonView& parameter) {
  static const std::map<std::string, Kind> kinds = {
      {"length", Kind::length},
      {"thickness", Kind::thickness},
      {"width", Kind::width},
      {"E", Kind::E},
      {"density", Kind::density},
      {"poisson_ratio", Kind::poisson_ratio},
      {"base_side", Kind::base_side},
      {"platform_side", Kind::platform_side},
      {"platform_mass", Kind::platform_mass},
      {"platform_inertia", Kind::platform_inertia},
      {"active_stiffness", Kind::active_stiffness},
      {"elbow_stiffness", Kind::elbow_stiffness},
      {"platform_joint_stiffness", Kind::platform_joint_stiffness},
      {"orientation", Kind::orientation}};
  solver::DesignParameter read{.kind = kinds.at(parameter.text("property"))};
  if (read.kind > Kind::poisson_ratio) {
    for (const char* key : {"links", "platform"})
      if (parameter.has(key)) throw parameter[key].error("expected it beside a property of links");
    return read;
  }
  read.platform = parameter.get("platform", false);
  if (const auto links = parameter.find("links")) {
    read.proximal.fill(false);
    read.distal.fill(false);
    for (const auto& entry : links->entries()) choose(entry.second.get<std::string>(), read);
  }
  const bool platform_has = read.kind != Kind::length && read.kind != Kind::width;
  if (read.platform && !platform_has) {
    throw parameter["platform"].error(
        "expected the thickness, E, density or Poisson's ratio of the platform");
  }
  const auto any = [](const std::array<bool, 3>& selected) {
    return std::ranges::count(selected, true) > 0;
  };
  if (!any(read.proximal) && !any(read.distal) && !read.platform) {
    throw parameter.error("expected a link, or the platform");
  }
  return read;
}

std::string sensitivity_name(Kind kind) {
  switch (kind) {
    case Kind::E:
      return "sensitivity_Hz_per_Pa";
    case Kind::density:
      return "sensitivity_Hz_m3_per_kg";
    case Kind::poisson_ratio:
      return "sensitivity_Hz";
    case Kind::platform_mass:
      return "sensitivity_Hz_per_kg";
    case Kind::platform_inertia:
      return "sensitivity_Hz_per_kg_m2";
    case Kind::active_stiffness:
    case Kind::elbow_stiffness:
    case Kind::platform_joint_stiffness:
      return "sensitivity_Hz_rad_per_N_m";
    case Kind::orientation:
      return "sensitivity_Hz_per_rad";
    default:
      return "sensitivity_Hz_per_m";
  }
}

}  // namespace trammel::harness
