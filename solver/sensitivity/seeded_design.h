#pragma once

#include <array>
#include <cmath>

#include "solver/elements/frame_element.h"
#include "solver/sensitivity/design_parameter.h"

/// A design whose numbers carry their derivatives with respect to one parameter, up to what the
/// elements are made of, the pose held.
namespace trammel::solver {

namespace detail {

[[nodiscard]] inline MaterialOf<Dual> lifted(const Material& m) {
  return {.E = Dual(m.E), .rho = Dual(m.rho), .nu = Dual(m.nu)};
}

[[nodiscard]] inline LinkDesignOf<Dual> lifted(const LinkDesign& link) {
  return {.thickness = Dual(link.thickness),
          .width = Dual(link.width),
          .material = lifted(link.material),
          .shear_coefficient = link.shear_coefficient,
          .theory = link.theory,
          .mass_matrix = link.mass_matrix,
          .elements = link.elements,
          .axially_flexible = link.axially_flexible,
          .mass = link.mass,
          .inertia = link.inertia};
}

[[nodiscard]] inline PlatformDesignOf<Dual> lifted(const PlatformDesign& platform) {
  return {.kind = platform.kind,
          .thickness = Dual(platform.thickness),
          .material = lifted(platform.material),
          .refinements = platform.refinements,
          .six_nodes = platform.six_nodes,
          .pin_radius = platform.pin_radius,
          .mass = platform.mass,
          .inertia = platform.inertia};
}

inline void seed(Dual* x) {
  if (x != nullptr) *x = with_derivative(value(*x), 1);
}

}  // namespace detail

/// A link with its derivative: what of it the elements need.
struct SeededLink {
  SectionOf<Dual> section;
  Eigen::Vector2<Dual> direction;
  Dual length;
};

/// The design with d/dp = 1 on the numbers that the parameter names.
class SeededDesign {
 public:
  SeededDesign(const ManipulatorDesign& design, const Posture& posture,
               const DesignParameter& parameter)
      : platform_(detail::lifted(design.platform)) {
    const ManipulatorGeometry& g = design.geometry;
    if (parameter.platform) detail::seed(detail::number(platform_, parameter.kind));
    platform_mass_ = trammel::solver::platform_mass(platform_, g.platform);
    const bool length = parameter.kind == DesignParameter::Kind::length;
    for (std::size_t i = 0; i < 3; ++i) {
      LinkDesignOf<Dual> proximal = detail::lifted(design.proximal[i]);
      LinkDesignOf<Dual> distal = detail::lifted(design.distal[i]);
      if (parameter.proximal[i]) detail::seed(detail::link_number(proximal, parameter.kind));
      if (parameter.distal[i]) detail::seed(detail::link_number(distal, parameter.kind));
      const Dual a = with_derivative(g.proximal[i], length && parameter.proximal[i] ? 1 : 0);
      const Dual b = with_derivative(g.distal[i], length && parameter.distal[i] ? 1 : 0);
      const Eigen::Vector2<Dual> A = g.base[i].cast<Dual>();
      const Eigen::Vector2<Dual> C = posture.C[i].cast<Dual>();
      // Of a straight limb the angles change infinitely fast, but only with its own lengths.
      const Eigen::Vector2<Dual> B =
          derivative(a) == 0 && derivative(b) == 0
              ? Eigen::Vector2<Dual>(posture.B[i].cast<Dual>())
              : elbow_position(g.base[i], posture.C[i], a, b, g.working_mode[i]);
      links_[2 * i] = make(proximal, a, A, B);
      links_[2 * i + 1] = make(distal, b, B, C);
    }
  }

  /// In the order of the built model's members.
  [[nodiscard]] const SeededLink& link(Index member) const {
    return links_[static_cast<std::size_t>(member)];
  }
  [[nodiscard]] const PlatformMassOf<Dual>& platform_mass() const { return platform_mass_; }
  /// The triangles' stiffness is in proportion to E t and their mass to the total: d ln / dp.
  [[nodiscard]] double log_stiffness_derivative() const {
    const Dual product = platform_.material.E * platform_.thickness;
    return derivative(product) == 0 ? 0 : derivative(product) / value(product);
  }
  [[nodiscard]] double log_mass_derivative() const {
    return derivative(platform_mass_.mass) == 0
               ? 0
               : derivative(platform_mass_.mass) / value(platform_mass_.mass);
  }

 private:
  static SeededLink make(const LinkDesignOf<Dual>& link, const Dual& nominal,
                         const Eigen::Vector2<Dual>& from, const Eigen::Vector2<Dual>& to) {
    const Eigen::Vector2<Dual> span = to - from;
    using std::sqrt;
    const Dual length = sqrt(Dual(span.x() * span.x() + span.y() * span.y()));
    return {link_section(link, nominal), {span.x() / length, span.y() / length}, length};
  }

  PlatformDesignOf<Dual> platform_;
  PlatformMassOf<Dual> platform_mass_;
  std::array<SeededLink, 6> links_;
};

}  // namespace trammel::solver
