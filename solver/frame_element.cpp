#include "solver/frame_element.h"

#include <array>

namespace trammel {
namespace {

struct QuadraturePoint {
  double at;
  double weight;
};

/// Gauss-Legendre on [0, 1], exact to degree 7: the products of two cubics have degree 6.
constexpr std::array<QuadraturePoint, 4> kGauss = {{
    {0.069431844202973712388026755553595, 0.173927422568726928686531974610999},
    {0.330009478207571867598667120448378, 0.326072577431273071313468025389000},
    {0.669990521792428132401332879551622, 0.326072577431273071313468025389000},
    {0.930568155797026287611973244446405, 0.173927422568726928686531974610999},
}};

double rotary_inertia(const Section& section, BeamTheory theory) {
  return has_rotary_inertia(theory) ? section.inertia_per_length : 0.0;
}

}  // namespace

Section interpolate(const Section& first, const Section& second, double at) {
  const auto mix = [at](double a, double b) { return (1 - at) * a + at * b; };
  Section section;
  section.EA = mix(first.EA, second.EA);
  section.EI = mix(first.EI, second.EI);
  section.kappa_GA = mix(first.kappa_GA, second.kappa_GA);
  section.mass_per_length = mix(first.mass_per_length, second.mass_per_length);
  section.inertia_per_length = mix(first.inertia_per_length, second.inertia_per_length);
  section.area = mix(first.area, second.area);
  section.section_modulus = mix(first.section_modulus, second.section_modulus);
  return section;
}

double shear_ratio(const Section& section, BeamTheory theory, double length) {
  if (!shears(theory)) return 0;
  return 12 * section.EI / (section.kappa_GA * length * length);
}

FrameDeformation frame_deformation(const Vector2d& direction, double length) {
  const double c = direction.x();
  const double s = direction.y();
  const double r = 2 / length;
  FrameDeformation B;
  B << -c, -s, 0, c, s, 0,  //
      0, 0, -1, 0, 0, 1,    //
      -r * s, r * c, 1, r * s, -r * c, 1;
  return B;
}

Vector3d frame_rigidity(const Section& section, BeamTheory theory, double length) {
  const double phi = shear_ratio(section, theory, length);
  return {section.EA / length, section.EI / length, 3 * section.EI / (length * (1 + phi))};
}

Matrix6d frame_stiffness(const Section& section, BeamTheory theory, double length) {
  const FrameDeformation B = frame_deformation(Vector2d::UnitX(), length);
  return B.transpose() * frame_rigidity(section, theory, length).asDiagonal() * B;
}

FrameInterpolation frame_interpolation(double shear_ratio, double length, double xi) {
  const double x2 = xi * xi;
  const double x3 = x2 * xi;
  const double phi = shear_ratio;
  const double g = 1 / (1 + phi);
  const double h = 0.5 * phi * (xi - x2);
  FrameInterpolation N = FrameInterpolation::Zero();
  N(0, 0) = 1 - xi;
  N(0, 3) = xi;
  N(1, 1) = g * (1 - 3 * x2 + 2 * x3 + phi * (1 - xi));
  N(1, 2) = g * length * (xi - 2 * x2 + x3 + h);
  N(1, 4) = g * (3 * x2 - 2 * x3 + phi * xi);
  N(1, 5) = g * length * (x3 - x2 - h);
  N(2, 1) = g * 6 * (x2 - xi) / length;
  N(2, 2) = g * (1 - 4 * xi + 3 * x2 + phi * (1 - xi));
  N(2, 4) = -N(2, 1);
  N(2, 5) = g * (3 * x2 - 2 * xi + phi * xi);
  return N;
}

Matrix6d frame_mass(const Section& section, BeamTheory theory, MassMatrix mass, double length) {
  const double m = section.mass_per_length * length;
  const double J = rotary_inertia(section, theory) * length;
  Matrix6d M = Matrix6d::Zero();
  if (mass == MassMatrix::lumped) {
    M.diagonal() << m / 2, m / 2, J / 2, m / 2, m / 2, J / 2;
    return M;
  }
  const double phi = shear_ratio(section, theory, length);
  for (const QuadraturePoint& point : kGauss) {
    const FrameInterpolation N = frame_interpolation(phi, length, point.at);
    M += N.transpose() * (point.weight * Vector3d(m, m, J)).asDiagonal() * N;
  }
  return (M + M.transpose()) / 2;
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

Matrix6d frame_rotation(const Vector2d& direction) {
  Matrix6d R = Matrix6d::Zero();
  for (const Index node : {Index{0}, Index{3}}) {
    R(node, node) = R(node + 1, node + 1) = direction.x();
    R(node, node + 1) = direction.y();
    R(node + 1, node) = -direction.y();
    R(node + 2, node + 2) = 1;
  }
  return R;
}

}  // namespace trammel
