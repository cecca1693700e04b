#include "harness/statics_modes/design_change.h"

#include <algorithm>

namespace trammel::harness {

using solver::DesignParameter;
using solver::ManipulatorDesign;
using solver::Vector2d;
using Kind = DesignParameter::Kind;

namespace {

/// Calls visit(number) for each number of links and platform that the parameter names.
template <class Visit>
void for_each_number(ManipulatorDesign& design, const DesignParameter& parameter, Visit&& visit) {
  const Kind kind = parameter.kind;
  const bool length = kind == Kind::length;
  const auto meet = [&visit](double* x) {
    if (x != nullptr) visit(*x);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    if (parameter.proximal[i]) {
      meet(length ? &design.geometry.proximal[i]
                  : solver::detail::link_number(design.proximal[i], kind));
    }
    if (parameter.distal[i]) {
      meet(length ? &design.geometry.distal[i]
                  : solver::detail::link_number(design.distal[i], kind));
    }
  }
  if (parameter.platform) meet(solver::detail::number(design.platform, kind));
}

/// Calls visit(stiffness) for each spring at the joints that the parameter names.
template <class Visit>
void for_each_spring(ManipulatorDesign& design, Kind kind, Visit&& visit) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (kind == Kind::active_stiffness && design.active[i].kind == solver::ActiveKind::sprung)
      visit(design.active[i].stiffness);
    if (kind == Kind::elbow_stiffness && design.elbow[i].kind == solver::ElbowKind::sprung)
      visit(design.elbow[i].stiffness);
    if (kind == Kind::platform_joint_stiffness &&
        design.platform_joint[i].kind == solver::PlatformJointKind::sprung)
      visit(design.platform_joint[i].stiffness);
  }
}

double side(const std::array<Vector2d, 3>& triangle) {
  return (triangle[1] - triangle[0]).norm();
}

void grow(std::array<Vector2d, 3>& triangle, const Vector2d& about, double change) {
  const double factor = change / side(triangle);
  for (Vector2d& corner : triangle) corner += factor * (corner - about);
}

}  // namespace

DesignInPose perturbed(const ManipulatorDesign& design, const solver::Pose& pose,
                       const DesignParameter& parameter, double change) {
  DesignInPose changed{design, pose};
  ManipulatorDesign& result = changed.design;
  const auto add = [change](double& x) { x += change; };
  switch (parameter.kind) {
    case Kind::base_side:
      grow(result.geometry.base, design.geometry.base[0], change);
      break;
    case Kind::platform_side:
      grow(result.geometry.platform, Vector2d::Zero(), change);
      break;
    case Kind::platform_mass:
      result.platform.mass = solver::platform_mass(design).mass + change;
      break;
    case Kind::platform_inertia:
      result.platform.inertia = parameter_value(design, parameter) + change;
      break;
    case Kind::orientation:
      changed.pose.phi += change;
      break;
    case Kind::active_stiffness:
    case Kind::elbow_stiffness:
    case Kind::platform_joint_stiffness:
      for_each_spring(result, parameter.kind, add);
      break;
    default:
      for_each_number(result, parameter, add);
  }
  return changed;
}

double parameter_value(const ManipulatorDesign& design, const DesignParameter& parameter) {
  ManipulatorDesign copy = design;
  double largest = 0;
  const auto meet = [&largest](double& x) { largest = std::max(largest, x); };
  switch (parameter.kind) {
    case Kind::base_side:
      return side(design.geometry.base);
    case Kind::platform_side:
      return side(design.geometry.platform);
    case Kind::platform_mass:
      return solver::platform_mass(design).mass;
    case Kind::platform_inertia: {
      if (design.platform.kind != solver::PlatformKind::rigid) return 0;
      const solver::PlatformMass mass = solver::platform_mass(design);
      return design.platform.inertia.value_or(mass.inertia + mass.mass * mass.center.squaredNorm());
    }
    case Kind::orientation:
      return 1;
    case Kind::active_stiffness:
    case Kind::elbow_stiffness:
    case Kind::platform_joint_stiffness:
      for_each_spring(copy, parameter.kind, meet);
      return largest;
    default:
      for_each_number(copy, parameter, meet);
      return largest;
  }
}

}  // namespace trammel::harness
