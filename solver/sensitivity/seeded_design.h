#pragma once

#include <array>
#include <cmath>

#include "solver/elements/frame_element.h"
#include "solver/sensitivity/design_parameter.h"

/// A design whose numbers carry their derivatives with respect to one parameter, up to what the
/// elements are made of, the pose held.
namespace trammel::solver {

namespace detail {

template <Real T>
[[nodiscard]] MaterialOf<T> lifted(const Material& m) {
  return {.E = T(m.E), .rho = T(m.rho), .nu = T(m.nu)};
}

template <Real T>
[[nodiscard]] LinkDesignOf<T> lifted(const LinkDesign& link) {
  return {.thickness = T(link.thickness),
          .width = T(link.width),
          .material = lifted<T>(link.material),
          .shear_coefficient = link.shear_coefficient,
          .theory = link.theory,
          .mass_matrix = link.mass_matrix,
          .elements = link.elements,
          .axially_flexible = link.axially_flexible,
          .mass = link.mass,
          .inertia = link.inertia};
}

template <Real T>
[[nodiscard]] PlatformDesignOf<T> lifted(const PlatformDesign& platform) {
  return {.kind = platform.kind,
          .thickness = T(platform.thickness),
          .material = lifted<T>(platform.material),
          .refinements = platform.refinements,
          .six_nodes = platform.six_nodes,
          .pin_radius = platform.pin_radius,
          .mass = platform.mass,
          .inertia = platform.inertia};
}

template <Real T>
void seed(T* x) {
  if (x != nullptr) *x = with_derivative<T>(value(*x), 1);
}

}  // namespace detail

/// A link with its derivative: what of it the elements need.
template <Real T>
struct SeededLink {
  SectionOf<T> section;
  Eigen::Vector2<T> direction;
  T length;
};

/// The design with d/dp = 1 on the numbers that the parameter names.
template <Real T>
class SeededDesign {
 public:
  SeededDesign(const ManipulatorDesign& design, const Posture& posture,
               const DesignParameter& parameter)
      : platform_(detail::lifted<T>(design.platform)) {
    const ManipulatorGeometry& g = design.geometry;
    if (parameter.platform) detail::seed(detail::number(platform_, parameter.kind));
    platform_mass_ = trammel::solver::platform_mass(platform_, g.platform);
    const bool length = parameter.kind == DesignParameter::Kind::length;
    for (std::size_t i = 0; i < 3; ++i) {
      LinkDesignOf<T> proximal = detail::lifted<T>(design.proximal[i]);
      LinkDesignOf<T> distal = detail::lifted<T>(design.distal[i]);
      if (parameter.proximal[i]) detail::seed(detail::link_number(proximal, parameter.kind));
      if (parameter.distal[i]) detail::seed(detail::link_number(distal, parameter.kind));
      const T a = with_derivative<T>(g.proximal[i], length && parameter.proximal[i] ? 1 : 0);
      const T b = with_derivative<T>(g.distal[i], length && parameter.distal[i] ? 1 : 0);
      const Eigen::Vector2<T> A = g.base[i].cast<T>();
      const Eigen::Vector2<T> C = posture.C[i].cast<T>();
      // Of a straight limb the angles change infinitely fast, but only with its own lengths.
      const Eigen::Vector2<T> B =
          derivative(a) == 0 && derivative(b) == 0
              ? Eigen::Vector2<T>(posture.B[i].cast<T>())
              : elbow_position(g.base[i], posture.C[i], a, b, g.working_mode[i]);
      links_[2 * i] = make(proximal, a, A, B);
      links_[2 * i + 1] = make(distal, b, B, C);
    }
  }

  /// In the order of the built model's members.
  [[nodiscard]] const SeededLink<T>& link(Index member) const {
    return links_[static_cast<std::size_t>(member)];
  }
  [[nodiscard]] const PlatformMassOf<T>& platform_mass() const { return platform_mass_; }
  /// The triangles' stiffness is in proportion to E t and their mass to the total: d ln / dp.
  [[nodiscard]] double log_stiffness_derivative() const {
    const T product = platform_.material.E * platform_.thickness;
    return derivative(product) == 0 ? 0 : derivative(product) / value(product);
  }
  [[nodiscard]] double log_mass_derivative() const {
    return derivative(platform_mass_.mass) == 0
               ? 0
               : derivative(platform_mass_.mass) / value(platform_mass_.mass);
  }

 private:
  static SeededLink<T> make(const LinkDesignOf<T>& link, const T& nominal,
                            const Eigen::Vector2<T>& from, const Eigen::Vector2<T>& to) {
    const Eigen::Vector2<T> span = to - from;
    using std::sqrt;
    const T length = sqrt(T(span.x() * span.x() + span.y() * span.y()));
    return {link_section(link, nominal), {span.x() / length, span.y() / length}, length};
  }

  PlatformDesignOf<T> platform_;
  PlatformMassOf<T> platform_mass_;
  std::array<SeededLink<T>, 6> links_;
};

}  // namespace trammel::solver
