#include "solver/elements/frame_element.h"

#include <cmath>

namespace trammel::solver {
namespace {

/// Returns a section in which each property has the value mix(a, b, n). a and b are the values of
/// the property in the sections `first` and `second`. The property is proportional to depth^n times
/// width.
template <class Mix>
Section mixed(const Section& first, const Section& second, const Mix& mix) {
  Section section;
  section.EA = mix(first.EA, second.EA, 1);
  section.EI = mix(first.EI, second.EI, 3);
  section.kappa_GA = mix(first.kappa_GA, second.kappa_GA, 1);
  section.mass_per_length = mix(first.mass_per_length, second.mass_per_length, 1);
  section.inertia_per_length = mix(first.inertia_per_length, second.inertia_per_length, 3);
  section.area = mix(first.area, second.area, 1);
  section.section_modulus = mix(first.section_modulus, second.section_modulus, 2);
  return section;
}

/// Returns the section at the fraction `at` of the distance between two sections, for linear depth
/// and width. The ratio of the depths equals the ratio of the radii of gyration.
Section section_by_dimensions(const Section& first, const Section& second, double at) {
  const double depth_ratio = std::sqrt(second.EI / second.EA / (first.EI / first.EA));
  const double width_ratio = second.area / first.area / depth_ratio;
  const double depth = 1 + at * (depth_ratio - 1), width = 1 + at * (width_ratio - 1);
  return mixed(first, second, [&](double a, double b, int n) {
    const double modulus = (1 - at) * a + at * b / (std::pow(depth_ratio, n) * width_ratio);
    return modulus * std::pow(depth, n) * width;
  });
}

}  // namespace

Section section_at(const Member& member, double at) {
  const Section &first = member.section, &second = member.end_section;
  switch (member.taper) {
    case Taper::linear_depth_and_width:
      return section_by_dimensions(first, second, at);
    case Taper::exponential:
      return mixed(first, second,
                   [at](double a, double b, int) { return std::pow(a, 1 - at) * std::pow(b, at); });
    case Taper::linear_area_and_inertia:
      break;
  }
  return mixed(first, second, [at](double a, double b, int) { return (1 - at) * a + at * b; });
}

Matrix6d bar_mass(const Section& section, MassMatrix mass, double length) {
  const double m = section.mass_per_length * length;
  const bool lumped = mass == MassMatrix::lumped;
  Matrix6d M = Matrix6d::Zero();
  for (const Index i : {0, 1}) {
    M(i, i) = M(i + 3, i + 3) = lumped ? m / 2 : m / 3;
    M(i, i + 3) = M(i + 3, i) = lumped ? 0 : m / 6;
  }
  return M;
}

Vector6d frame_uniform_load(const Vector2d& load, double length) {
  const double moment = load.y() * length * length / 12;
  const Vector2d half = load * length / 2;
  Vector6d f;
  f << half, moment, half, -moment;
  return f;
}

}  // namespace trammel::solver
