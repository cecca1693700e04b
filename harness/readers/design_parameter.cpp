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
  static const std::map<std::string, Kind> kinds = {{"length", Kind::length},
                                                    {"thickness", Kind::thickness},
                                                    {"width", Kind::width},
                                                    {"E", Kind::E},
                                                    {"density", Kind::density}};
  solver::DesignParameter read{.kind = kinds.at(parameter.text("property"))};
  read.platform = parameter.get("platform", false);
  if (const auto links = parameter.find("links")) {
    read.proximal.fill(false);
    read.distal.fill(false);
    for (const auto& entry : links->entries()) choose(entry.second.get<std::string>(), read);
  }
  const bool platform_has = read.kind != Kind::length && read.kind != Kind::width;
  if (read.platform && !platform_has) {
    throw parameter["platform"].error("expected the thickness, E or density of the platform");
  }
  const auto any = [](const std::array<bool, 3>& selected) {
    return std::count(selected.begin(), selected.end(), true) > 0;
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
    case Kind::length:
    case Kind::thickness:
    case Kind::width:
      break;
  }
  return "sensitivity_Hz_per_m";
}

}  // namespace trammel::harness
