#include "solver/elements/frame_element.h"

#include <array>
#include <cmath>

namespace trammel::solver {
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

template <Real T>
T rotary_inertia(const SectionOf<T>& section, BeamTheory theory) {
  return has_rotary_inertia(theory) ? section.inertia_per_length : T(0);
}

/// A section with mix(a, b, n) of each property of two, which goes with depth^n width.
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

/// The depth is in proportion to the radius of gyration.
Section with_linear_dimensions(const Section& first, const Section& second, double at) {
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
      return with_linear_dimensions(first, second, at);
    case Taper::exponential:
      return mixed(first, second,
                   [at](double a, double b, int) { return std::pow(a, 1 - at) * std::pow(b, at); });
    case Taper::linear_area_and_inertia:
      break;
  }
  return mixed(first, second, [at](double a, double b, int) { return (1 - at) * a + at * b; });
}

template <Real T>
T shear_ratio(const SectionOf<T>& section, BeamTheory theory,
              const std::type_identity_t<T>& length) {
  if (!has_shear_deformation(theory)) return T(0);
  return 12.0 * section.EI / (section.kappa_GA * length * length);
}

template <Real T>
Matrix36<T> frame_deformation_matrix(const Eigen::Vector2<T>& direction,
                                     const std::type_identity_t<T>& length) {
  const T c = direction.x();
  const T s = direction.y();
  const T rs = 2.0 / length * s;
  const T rc = 2.0 / length * c;
  Matrix36<T> B = Matrix36<T>::Zero();
  B(0, 3) = c;
  B(0, 4) = s;
  B(0, 0) = -c;
  B(0, 1) = -s;
  B(1, 2) = -1;
  B(1, 5) = 1;
  B(2, 0) = -rs;
  B(2, 1) = rc;
  B(2, 3) = rs;
  B(2, 4) = -rc;
  B(2, 2) = B(2, 5) = 1;
  return B;
}

template <Real T>
Eigen::Vector3<T> frame_rigidity(const SectionOf<T>& section, BeamTheory theory,
                                 const std::type_identity_t<T>& length) {
  const T phi = shear_ratio(section, theory, length);
  return {section.EA / length, section.EI / length, 3.0 * section.EI / (length * (1.0 + phi))};
}

Matrix6d frame_stiffness(const Section& section, BeamTheory theory, double length) {
  const FrameDeformation B = frame_deformation_matrix<double>(Vector2d::UnitX(), length);
  return B.transpose() * frame_rigidity(section, theory, length).asDiagonal() * B;
}

template <Real T>
Matrix36<T> frame_interpolation(const T& shear_ratio, const std::type_identity_t<T>& length,
                                double xi) {
  const double x2 = xi * xi;
  const double x3 = x2 * xi;
  const T phi = shear_ratio;
  const T g = 1.0 / (1.0 + phi);
  const T h = 0.5 * phi * (xi - x2);
  Matrix36<T> N = Matrix36<T>::Zero();
  N(0, 0) = 1 - xi;
  N(0, 3) = xi;
  N(1, 1) = g * (1 - 3 * x2 + 2 * x3 + phi * (1 - xi));
  N(1, 2) = g * length * (xi - 2 * x2 + x3 + h);
  N(1, 4) = g * (3 * x2 - 2 * x3 + phi * xi);
  N(1, 5) = g * length * (x3 - x2 - h);
  N(2, 1) = g * 6.0 * (x2 - xi) / length;
  N(2, 2) = g * (1 - 4 * xi + 3 * x2 + phi * (1 - xi));
  N(2, 4) = -N(2, 1);
  N(2, 5) = g * (3 * x2 - 2 * xi + phi * xi);
  return N;
}

template <Real T>
Matrix6<T> frame_mass(const SectionOf<T>& section, BeamTheory theory, MassMatrix mass,
                      const std::type_identity_t<T>& length) {
  const T m = section.mass_per_length * length;
  const T J = rotary_inertia(section, theory) * length;
  Matrix6<T> M = Matrix6<T>::Zero();
  if (mass == MassMatrix::lumped) {
    M(0, 0) = M(1, 1) = M(3, 3) = M(4, 4) = m / 2.0;
    M(2, 2) = M(5, 5) = J / 2.0;
    return M;
  }
  const T phi = shear_ratio(section, theory, length);
  for (const QuadraturePoint& point : kGauss) {
    const Matrix36<T> N = frame_interpolation(phi, length, point.at);
    const T w(point.weight);
    for (const Index i : {0, 3})
      for (const Index j : {0, 3}) M(i, j) += N(0, i) * (w * m) * N(0, j);
    for (const Index i : {1, 2, 4, 5}) {
      for (const Index j : {1, 2, 4, 5})
        M(i, j) += N(1, i) * (w * m) * N(1, j) + N(2, i) * (w * J) * N(2, j);
    }
  }
  return (M + M.transpose().eval()) * T(0.5);
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

template <Real T>
Matrix6<T> frame_rotation(const Eigen::Vector2<T>& direction) {
  Matrix6<T> R = Matrix6<T>::Zero();
  for (const Index node : {Index{0}, Index{3}}) {
    R(node, node) = R(node + 1, node + 1) = direction.x();
    R(node, node + 1) = direction.y();
    R(node + 1, node) = -direction.y();
    R(node + 2, node + 2) = 1;
  }
  return R;
}

template double shear_ratio(const SectionOf<double>&, BeamTheory, const double&);
template Dual shear_ratio(const SectionOf<Dual>&, BeamTheory, const Dual&);
template Matrix36<double> frame_deformation_matrix(const Eigen::Vector2<double>&, const double&);
template Matrix36<Dual> frame_deformation_matrix(const Eigen::Vector2<Dual>&, const Dual&);
template Eigen::Vector3<double> frame_rigidity(const SectionOf<double>&, BeamTheory, const double&);
template Eigen::Vector3<Dual> frame_rigidity(const SectionOf<Dual>&, BeamTheory, const Dual&);
template Matrix36<double> frame_interpolation(const double&, const double&, double);
template Matrix36<Dual> frame_interpolation(const Dual&, const Dual&, double);
template Matrix6<double> frame_mass(const SectionOf<double>&, BeamTheory, MassMatrix,
                                    const double&);
template Matrix6<Dual> frame_mass(const SectionOf<Dual>&, BeamTheory, MassMatrix, const Dual&);
template Matrix6<double> frame_rotation(const Eigen::Vector2<double>&);
template Matrix6<Dual> frame_rotation(const Eigen::Vector2<Dual>&);

}  // namespace trammel::solver
