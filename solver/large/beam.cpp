#include "solver/large/beam.h"

#include <Eigen/LU>

namespace trammel::solver::large_motion {

namespace {

constexpr int kNodes = BeamInterpolation::kNodes, kPoints = BeamInterpolation::kPoints;
using NodeValues = Eigen::Matrix<double, kNodes, 1>;
using Monomials = Eigen::Matrix<double, 1, kNodes>;
/// Indices of the nodal rotations among the coordinates (ux, uy, theta) of the element nodes.
const auto kTurns = Eigen::seqN(Eigen::fix<2>, Eigen::fix<kNodes>, Eigen::fix<3>);

Monomials monomials(double x) {
  return {1, x, x * x, x * x * x};
}

/// Computes the shape functions and their integrals for x in [0, 1]. The Lobatto points and Gauss
/// rules in this function are those of the interval [-1, 1].
BeamInterpolation make_interpolation() {
  const std::array<double, kNodes> lobatto = {-1, -std::sqrt(0.2), std::sqrt(0.2), 1};
  const std::array<double, kPoints> point = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
  const double inner = std::sqrt(3.0 / 7 - 2.0 / 7 * std::sqrt(1.2));
  const double outer = std::sqrt(3.0 / 7 + 2.0 / 7 * std::sqrt(1.2));
  const double inner_weight = (18 + std::sqrt(30.0)) / 36;
  const double outer_weight = (18 - std::sqrt(30.0)) / 36;
  BeamInterpolation s;
  s.weight << 5.0 / 18, 8.0 / 18, 5.0 / 18;
  Eigen::Matrix4d at_nodes;
  for (int a = 0; a < kNodes; ++a) {
    const double x = lobatto[static_cast<std::size_t>(a)];
    s.node[static_cast<std::size_t>(a)] = (1 + x) / 2;
    at_nodes.row(a) = monomials(x);
  }
  const Eigen::Matrix4d lagrange = at_nodes.inverse();  // coefficients of each Lagrange polynomial
  for (int g = 0; g < kPoints; ++g) {
    const double x = point[static_cast<std::size_t>(g)];
    s.value.row(g) = monomials(x) * lagrange;
    s.slope.row(g) = 2 * Monomials(0, 1, 2 * x, 3 * x * x) * lagrange;
  }
  s.bending = s.slope.transpose() * s.weight.asDiagonal() * s.slope;
  s.integral.setZero();
  s.mass.setZero();
  for (const auto& [x, weight] : {std::pair(-outer, outer_weight), std::pair(-inner, inner_weight),
                                  std::pair(inner, inner_weight), std::pair(outer, outer_weight)}) {
    const NodeValues n = (monomials(x) * lagrange).transpose();
    s.integral += weight / 2 * n;
    s.mass += weight / 2 * n * n.transpose();
  }
  return s;
}

/// Strains (stretch and shear) at a Gauss point. The unit vector e1 is normal to the cross section,
/// and e2 is parallel to it.
struct Strain {
  Vector2d e1, e2;
  double stretch = 0, shear = 0;

  Strain(const Beam& beam, const Beam::Coordinates& q, int g) {
    const BeamInterpolation& s = beam_interpolation();
    Vector2d slope = Vector2d::Zero();
    double rotation = 0;
    for (int a = 0; a < kNodes; ++a) {
      slope += s.slope(g, a) / beam.length * (q.segment<2>(3 * a) - q.head<2>());
      rotation += s.value(g, a) * q[3 * a + 2];
    }
    const double cosine = std::cos(rotation), sine = std::sin(rotation);
    const Vector2d normal = perpendicular(beam.axis);
    e1 = cosine * beam.axis + sine * normal;
    e2 = cosine * normal - sine * beam.axis;
    stretch = e1.dot(slope) + cosine_minus_one(rotation);
    shear = e2.dot(slope) - sine;
  }

  /// Sets the derivatives of stretch and shear at Gauss point g with respect to the coordinates of
  /// node a. `slope` multiplies the derivatives with respect to the displacements, and `value`
  /// multiplies the derivatives with respect to the rotation.
  void set_rows(int g, int a, double slope, double value, Beam::Gradient& G) const {
    G.block<1, 2>(2 * g, 3 * a) = slope * e1.transpose();
    G(2 * g, 3 * a + 2) = value * shear;
    G.block<1, 2>(2 * g + 1, 3 * a) = slope * e2.transpose();
    G(2 * g + 1, 3 * a + 2) = -value * (1 + stretch);
  }
};

}  // namespace

const BeamInterpolation& beam_interpolation() {
  static const BeamInterpolation table = make_interpolation();
  return table;
}

void Beam::constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
  const BeamInterpolation& s = beam_interpolation();
  for (int g = 0; g < kPoints; ++g) {
    const Strain strain(*this, q, g);
    const double w = s.weight[g] * length;
    residual[2 * g] = w * strain.stretch;
    residual[2 * g + 1] = w * strain.shear;
    for (int a = 0; a < kNodes; ++a)
      strain.set_rows(g, a, s.weight[g] * s.slope(g, a), w * s.value(g, a), G);
  }
}

Beam::Square Beam::geometric_stiffness(const Coordinates& q, const Rows& lambda) const {
  const BeamInterpolation& s = beam_interpolation();
  Square K = Square::Zero();
  for (int g = 0; g < kPoints; ++g) {
    const Strain at(*this, q, g);
    const double normal = s.weight[g] * lambda[2 * g], shear = s.weight[g] * lambda[2 * g + 1];
    const Vector2d mixed = normal * at.e2 - shear * at.e1;
    const double rotational = -length * (normal * (1 + at.stretch) + shear * at.shear);
    for (int a = 0; a < kNodes; ++a) {
      for (int b = 0; b < kNodes; ++b) {
        const Vector2d coupled = s.slope(g, a) * s.value(g, b) * mixed;
        K.block<2, 1>(3 * a, 3 * b + 2) += coupled;
        K.block<1, 2>(3 * b + 2, 3 * a) += coupled.transpose();
        K(3 * a + 2, 3 * b + 2) += rotational * s.value(g, a) * s.value(g, b);
      }
    }
  }
  return K;
}

Beam::Gradient Beam::discrete_gradient(const Coordinates& q0, const Coordinates& q1) const {
  const BeamInterpolation& s = beam_interpolation();
  Gradient D;
  for (int g = 0; g < kPoints; ++g) {
    const Strain midpoint(*this, (q0 + q1) / 2, g);
    const double rotation = s.value.row(g).dot(NodeValues((q1 - q0)(kTurns)));
    const double c = std::cos(rotation / 2), k = sinc(rotation / 2);
    for (int a = 0; a < kNodes; ++a)
      midpoint.set_rows(g, a, s.weight[g] * s.slope(g, a) * c,
                        s.weight[g] * length * s.value(g, a) * k, D);
  }
  return D;
}

/// Computes the moments from rotations relative to the first node, so that a rigid rotation cancels
/// before the multiplication by the stiffness. Otherwise, the round-off error of the rotation would
/// act as a moment at every node. In a member of length L with n elements, the sum of these moments
/// would be n^2 eps EI/L, with the machine precision eps.
Beam::Coordinates Beam::forces(const Coordinates& q, const Coordinates& v, double tau) const {
  NodeValues relative = q(kTurns).array() - q[2];
  if (tau != 0) relative.array() += tau * (v(kTurns).array() - v[2]);
  Coordinates f = Coordinates::Zero();
  f(kTurns) = EI / length * (beam_interpolation().bending * relative);
  return f;
}

Beam::Square Beam::tangent(const Coordinates&, double stiffness_factor, double damping) const {
  Square K = Square::Zero();
  K(kTurns, kTurns) = (stiffness_factor + damping) * (EI / length * beam_interpolation().bending);
  return K;
}

double Beam::energy(const Coordinates& q) const {
  Coordinates relative = q;
  relative(kTurns).array() -= q[2];
  return relative.dot(forces(q, q, 0)) / 2;
}

Beam::Square Beam::mass() const {
  const BeamInterpolation& s = beam_interpolation();
  Square M = Square::Zero();
  for (int a = 0; a < kNodes; ++a) {
    for (int b = 0; b < kNodes; ++b) {
      const double m = length * (lumped ? (a == b ? s.integral[a] : 0.0) : s.mass(a, b));
      M(3 * a, 3 * b) = M(3 * a + 1, 3 * b + 1) = mass_per_length * m;
      M(3 * a + 2, 3 * b + 2) = inertia_per_length * m;
    }
  }
  return M;
}

Beam::Coordinates Beam::distributed_load(const Vector2d& force_per_length) const {
  Coordinates f = Coordinates::Zero();
  for (int a = 0; a < kNodes; ++a)
    f.segment<2>(3 * a) = length * beam_interpolation().integral[a] * force_per_length;
  return f;
}

Beam::Rows Beam::row_compliance() const {
  Rows c;
  for (int g = 0; g < kPoints; ++g) {
    const double w = beam_interpolation().weight[g] * length;
    c[2 * g] = w * stretch_compliance;
    c[2 * g + 1] = w * shear_compliance;
  }
  return c;
}

Beam::Rows Beam::row_penalty(const TangentCoefficients& coefficients) const {
  const double k = 12 * EI / (length * length);
  Rows rho;
  for (int g = 0; g < kPoints; ++g) {
    const double w = beam_interpolation().weight[g];
    rho[2 * g] = rho[2 * g + 1] = coefficients.stiffness * k / (w * length) +
                                  coefficients.mass * mass_per_length * length / (w * w);
  }
  return rho;
}

}  // namespace trammel::solver::large_motion
