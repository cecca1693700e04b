#pragma once

#include <array>

#include "solver/manipulator/manipulator.h"

namespace trammel::solver {

/// A number of the design, or several that change together by the same amount.
struct DesignParameter {
  enum class Kind { length, thickness, width, E, density };
  Kind kind = Kind::length;
  std::array<bool, 3> proximal{true, true, true};
  std::array<bool, 3> distal{true, true, true};
  bool platform = false;  ///< its thickness, E or density too
};

/// [m], [m], [m], [Pa], [kg/m^3].
[[nodiscard]] const char* unit(DesignParameter::Kind kind);

/// The design with the parameter increased by `change` [unit of the parameter].
[[nodiscard]] ManipulatorDesign perturbed(const ManipulatorDesign& design,
                                          const DesignParameter& parameter, double change);

/// The parameter's value [its unit]: the largest of the numbers that it names.
[[nodiscard]] double parameter_value(const ManipulatorDesign& design,
                                     const DesignParameter& parameter);

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
    case DesignParameter::Kind::length:
    case DesignParameter::Kind::width:
      break;
  }
  return nullptr;
}

template <class T>
[[nodiscard]] T* link_number(LinkDesignOf<T>& link, DesignParameter::Kind kind) {
  return kind == DesignParameter::Kind::width ? &link.width : number(link, kind);
}

}  // namespace detail

}  // namespace trammel::solver
