#pragma once

#include <array>

#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// A number of the design or its pose, or several that change together by the same amount.
struct DesignParameter {
  enum class Kind {
    length,
    thickness,
    width,
    E,
    density,
    poisson_ratio,             ///< of links and platform
    base_side,                 ///< A1-A2; the base grows about A1
    platform_side,             ///< C1-C2; the platform grows about P
    platform_mass,             ///< as if printed; a printed inertia stays
    platform_inertia,          ///< about P, as if printed; of a rigid platform
    active_stiffness,          ///< of the springs at A
    elbow_stiffness,           ///< at B
    platform_joint_stiffness,  ///< at C
    orientation                ///< phi of the pose
  };
  Kind kind = Kind::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  bool platform = false;  ///< its thickness, E, density or Poisson's ratio too
};

/// Returns true for parameters of which sections and links have exact derivatives: lengths,
/// thickness, width, E and density.
[[nodiscard]] inline bool is_seeded(DesignParameter::Kind kind) {
  return kind <= DesignParameter::Kind::density;
}

namespace detail {

/// The number of a part that the parameter names, or null.
template <class Part>
[[nodiscard]] auto number(Part& part, DesignParameter::Kind kind) -> decltype(&part.thickness) {
  switch (kind) {
    case DesignParameter::Kind::thickness:
      return &part.thickness;
    case DesignParameter::Kind::E:
      return &part.material.E;
    case DesignParameter::Kind::density:
      return &part.material.rho;
    case DesignParameter::Kind::poisson_ratio:
      return &part.material.nu;
    default:
      return nullptr;
  }
}

template <class T>
[[nodiscard]] T* link_number(LinkDesignOf<T>& link, DesignParameter::Kind kind) {
  return kind == DesignParameter::Kind::width ? &link.width : number(link, kind);
}

}  // namespace detail

}  // namespace trammel::solver
