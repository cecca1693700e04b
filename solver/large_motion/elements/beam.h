#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solver/large_motion/elements/constrained_system.h"
#include "solver/large_motion/elements/shape_functions.h"
#include "solver/model/plane.h"

namespace trammel::solver::large_motion {

/// cos(x) - 1 without cancellation.
inline double cosine_minus_one(double x) {
  const double s = std::sin(x / 2);
  return -2 * s * s;
}

/// sin(x) / x.
inline double sinc(double x) {
  return std::abs(x) < 1e-4 ? 1 - x * x / 6 : std::sin(x) / x;
}

/// Geometrically exact beam element (Simo-Reissner) with P + 1 nodes and P Gauss points, straight
/// when unloaded. With t0, n0 the element's axes and R(theta) the rotation of the section,
///
///     Gamma = R^T (t0 + u') - t0 = (stretch, shear),       kappa = theta',
///     energy = sum over Gauss points of  w h (N Gamma_1 + V Gamma_2 - N^2/2EA - V^2/2kGA)
///              + 1/2 integral of EI kappa^2.
///
/// N and V at the Gauss points are unknowns: each is the multiplier of a row g = w h Gamma of
/// compliance w h / EA or w h / kGA. Zero compliance is then exact: an inextensible member, an
/// Euler-Bernoulli member (J. C. Simo, CMAME 49, 1985; E. Reissner, ZAMP 23, 1972), and neither
/// ratio EA : EI : kGA enters the digits or Newton's path. Without a load inside, end nodes are
/// those of Gauss collocation of the rod's differential equation: error O(h^2P), no locking, and
/// for P >= 2 exact in the linear limit.
///
/// Coordinates: (ux, uy, theta) of each node along the element [m, m, rad]. Rows: stretch, shear
/// of each Gauss point [m].
template <int P>
struct Beam {
  static constexpr int N = 3 * (P + 1), R = 2 * P;
  using Coordinates = Eigen::Matrix<double, N, 1>;
  using Rows = Eigen::Matrix<double, R, 1>;
  using Gradient = Eigen::Matrix<double, R, N>;
  using Square = Eigen::Matrix<double, N, N>;

  Vector2d axis = Vector2d::UnitX();  ///< t0
  double length = 1;                  ///< h [m]
  double EI = 1;                      ///< [N m^2]
  double stretch_compliance = 0;      ///< 1/EA [1/N]
  double shear_compliance = 0;        ///< 1/kGA [1/N]
  double mass_per_length = 0;         ///< [kg/m]
  double inertia_per_length = 0;      ///< [kg m]
  bool lumped = false;

  void constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
    const ShapeFunctions<P>& s = shape_functions<P>();
    for (int g = 0; g < P; ++g) {
      const Strain at(*this, q, g);
      const double w = s.weight[g] * length;
      residual[2 * g] = w * at.stretch;
      residual[2 * g + 1] = w * at.shear;
      for (int a = 0; a <= P; ++a) {
        const double slope = s.weight[g] * s.slope(g, a), value = w * s.value(g, a);
        G.template block<1, 2>(2 * g, 3 * a) = slope * at.e1.transpose();
        G(2 * g, 3 * a + 2) = value * at.shear;
        G.template block<1, 2>(2 * g + 1, 3 * a) = slope * at.e2.transpose();
        G(2 * g + 1, 3 * a + 2) = -value * (1 + at.stretch);
      }
    }
  }

  /// sum of lambda_i d^2 g_i / dq^2.
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const {
    const ShapeFunctions<P>& s = shape_functions<P>();
    Square K = Square::Zero();
    for (int g = 0; g < P; ++g) {
      const Strain at(*this, q, g);
      const double normal = s.weight[g] * lambda[2 * g], shear = s.weight[g] * lambda[2 * g + 1];
      const Vector2d mixed = normal * at.e2 - shear * at.e1;
      const double rotational = -length * (normal * (1 + at.stretch) + shear * at.shear);
      for (int a = 0; a <= P; ++a) {
        for (int b = 0; b <= P; ++b) {
          const Vector2d coupled = s.slope(g, a) * s.value(g, b) * mixed;
          K.template block<2, 1>(3 * a, 3 * b + 2) += coupled;
          K.template block<1, 2>(3 * b + 2, 3 * a) += coupled.transpose();
          K(3 * a + 2, 3 * b + 2) += rotational * s.value(g, a) * s.value(g, b);
        }
      }
    }
    return K;
  }

  /// D with D (q1 - q0) = g(q1) - g(q0).
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const {
    const ShapeFunctions<P>& s = shape_functions<P>();
    const Coordinates midpoint = (q0 + q1) / 2;
    Gradient D;
    for (int g = 0; g < P; ++g) {
      const Strain at(*this, midpoint, g);
      double rotation = 0;
      for (int a = 0; a <= P; ++a) rotation += s.value(g, a) * (q1[3 * a + 2] - q0[3 * a + 2]);
      const double c = std::cos(rotation / 2), k = sinc(rotation / 2);
      for (int a = 0; a <= P; ++a) {
        const double slope = s.weight[g] * s.slope(g, a) * c;
        const double value = s.weight[g] * length * s.value(g, a) * k;
        D.template block<1, 2>(2 * g, 3 * a) = slope * at.e1.transpose();
        D(2 * g, 3 * a + 2) = value * at.shear;
        D.template block<1, 2>(2 * g + 1, 3 * a) = slope * at.e2.transpose();
        D(2 * g + 1, 3 * a + 2) = -value * (1 + at.stretch);
      }
    }
    return D;
  }

  /// Bending, constant because kappa is linear in the rotations.
  [[nodiscard]] Square stiffness() const {
    Square K = Square::Zero();
    const ShapeFunctions<P>& s = shape_functions<P>();
    for (int a = 0; a <= P; ++a) {
      for (int b = 0; b <= P; ++b) K(3 * a + 2, 3 * b + 2) = EI / length * s.stiffness(a, b);
    }
    return K;
  }

  /// Moments of bending at the nodes. From rotations beyond the first node's: what all turn by
  /// cancels before it is multiplied, not after. Its rounding would be a moment at every node of a
  /// row, n^2 eps EI/L in all of n elements.
  [[nodiscard]] Coordinates bending(const Coordinates& q) const { return stiffness() * bent(q); }
  [[nodiscard]] double bending_energy(const Coordinates& q) const {
    const Coordinates relative = bent(q);
    return relative.dot(stiffness() * relative) / 2;
  }

  [[nodiscard]] Square mass() const {
    Square M = Square::Zero();
    const ShapeFunctions<P>& s = shape_functions<P>();
    for (int a = 0; a <= P; ++a) {
      for (int b = 0; b <= P; ++b) {
        const double m = length * (lumped ? (a == b ? s.integral[a] : 0.0) : s.mass(a, b));
        M(3 * a, 3 * b) = M(3 * a + 1, 3 * b + 1) = mass_per_length * m;
        M(3 * a + 2, 3 * b + 2) = inertia_per_length * m;
      }
    }
    return M;
  }

  [[nodiscard]] Rows compliance() const {
    Rows c;
    for (int g = 0; g < P; ++g) {
      const double w = shape_functions<P>().weight[g] * length;
      c[2 * g] = w * stretch_compliance;
      c[2 * g + 1] = w * shear_compliance;
    }
    return c;
  }

  /// rho of `KktMatrix`: a shear stiffness 12 EI/h^2, which keeps bending and shear of one size,
  /// and the element's mass.
  [[nodiscard]] Rows penalty(const TangentCoefficients& coefficients) const {
    const double k = 12 * EI / (length * length);
    Rows rho;
    for (int g = 0; g < P; ++g) {
      const double w = shape_functions<P>().weight[g];
      rho[2 * g] = rho[2 * g + 1] = coefficients.stiffness * k / (w * length) +
                                    coefficients.mass * mass_per_length * length / (w * w);
    }
    return rho;
  }

 private:
  /// Rotations beyond the first node's; nothing of its motion else bends.
  [[nodiscard]] static Coordinates bent(const Coordinates& q) {
    Coordinates relative = Coordinates::Zero();
    for (int a = 1; a <= P; ++a) relative[3 * a + 2] = q[3 * a + 2] - q[2];
    return relative;
  }

  /// Strains and section axes of one Gauss point.
  struct Strain {
    Vector2d e1, e2;
    double stretch = 0, shear = 0;

    Strain(const Beam& beam, const Coordinates& q, int g) {
      const ShapeFunctions<P>& s = shape_functions<P>();
      Vector2d slope = Vector2d::Zero();
      double rotation = 0;
      for (int a = 0; a <= P; ++a) {
        slope +=
            s.slope(g, a) / beam.length * (q.template segment<2>(3 * a) - q.template head<2>());
        rotation += s.value(g, a) * q[3 * a + 2];
      }
      const double cosine = std::cos(rotation), sine = std::sin(rotation);
      const Vector2d normal = perpendicular(beam.axis);
      e1 = cosine * beam.axis + sine * normal;
      e2 = cosine * normal - sine * beam.axis;
      stretch = e1.dot(slope) + cosine_minus_one(rotation);
      shear = e2.dot(slope) - sine;
    }
  };
};

}  // namespace trammel::solver::large_motion
