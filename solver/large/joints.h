#pragma once

#include <Eigen/Core>
#include <cmath>

#include "solver/large/beam.h"
#include "solver/large/large_motion_model.h"
#include "solver/model/model.h"

/// Element types for joints, springs, bars, masses and follower forces, with the same interface as
/// `Beam`. A type with constraint rows g computes g and its gradient G. If the second derivative of
/// g is not zero, the type computes this derivative times the multipliers. If the discrete gradient
/// D differs from G, the type computes D with D (q1 - q0) = g(q1) - g(q0) (O. Gonzalez, J.
/// Nonlinear Sci. 6, 1996).
namespace trammel::solver::large_motion {

/// Joint with rigid constraint rows. The penalty rho of the rows (see `KktMatrix`) depends on the
/// joined members or bodies.
template <int Coords, int Count>
struct Joint : ElementSizes<Coords, Count> {
  using typename ElementSizes<Coords, Count>::Rows;
  /// Stiffness [N/m] and mass [kg] of the joined members or bodies.
  double stiffness_scale = 1, mass_scale = 1;

  [[nodiscard]] Rows row_compliance() const { return Rows::Zero(); }
  [[nodiscard]] Rows row_penalty(const TangentCoefficients& coefficients) const {
    return Rows::Constant(coefficients.stiffness * stiffness_scale +
                          coefficients.mass * mass_scale);
  }
};

/// Rigid link between the nodes a and b of a rigid body, with the vector d from a to b: u_b - u_a -
/// (R(theta_a) - I) d = 0. The coordinates are ua (2), theta_a, ub (2).
/// Source: Varalakshmi & Srinivas (2017), Eq. 20-24.
struct RigidLink : Joint<5, 2> {
  Vector2d offset = Vector2d::Zero();  ///< vector d from a to b in the pose of the model [m]

  void constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
    const Vector2d normal = perpendicular(offset);
    const double s = std::sin(q[2] / 2), sine = 2 * s * std::cos(q[2] / 2);
    const double cosine_minus_one = -2 * s * s;
    const Vector2d slope = (1 + cosine_minus_one) * normal - sine * offset;
    residual = q.tail<2>() - q.head<2>() - cosine_minus_one * offset - sine * normal;
    G << -Eigen::Matrix2d::Identity(), -slope, Eigen::Matrix2d::Identity();
  }
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const {
    Square K = Square::Zero();
    K(2, 2) = lambda.dot(rotated(offset, q[2]));
    return K;
  }
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const {
    const double half = (q1[2] - q0[2]) / 2;
    Gradient D;
    D << -Eigen::Matrix2d::Identity(),
        -sinc(half) * rotated(perpendicular(offset), (q0[2] + q1[2]) / 2),
        Eigen::Matrix2d::Identity();
    return D;
  }
};

/// Sliding joint of node b on a line with the normal n. The line turns with node a, or is fixed if
/// a is the ground: n(theta_a) . (x_b - x_a) = const. The coordinates are ua (2), theta_a, ub (2).
struct SlidingJoint : Joint<5, 1> {
  Vector2d normal = Vector2d::UnitY();  ///< normal n of the line in the pose of the model
  Vector2d offset = Vector2d::Zero();   ///< x_b - x_a in the pose of the model [m]

  void constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
    const Vector2d n = rotated(normal, q[2]);
    const Vector2d relative_displacement = q.tail<2>() - q.head<2>();
    const Vector2d change =
        cosine_minus_one(q[2]) * normal + std::sin(q[2]) * perpendicular(normal);
    residual[0] = n.dot(relative_displacement) + change.dot(offset);
    G << -n.transpose(), perpendicular(n).dot(offset + relative_displacement), n.transpose();
  }
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const {
    const Vector2d n = rotated(normal, q[2]), slope = lambda[0] * perpendicular(n);
    Square K = Square::Zero();
    K(2, 2) = -lambda[0] * n.dot(offset + q.tail<2>() - q.head<2>());
    K.block<2, 1>(0, 2) = -slope;
    K.block<1, 2>(2, 0) = -slope.transpose();
    K.block<2, 1>(3, 2) = slope;
    K.block<1, 2>(2, 3) = slope.transpose();
    return K;
  }
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const {
    const Coordinates midpoint = (q0 + q1) / 2;
    const double half = (q1[2] - q0[2]) / 2;
    const Vector2d n = rotated(normal, midpoint[2]);
    Gradient D;
    D << -std::cos(half) * n.transpose(),
        sinc(half) * perpendicular(n).dot(offset + midpoint.tail<2>() - midpoint.head<2>()),
        std::cos(half) * n.transpose();
    return D;
  }
};

/// Joint that prescribes the displacement of a coordinate u relative to another coordinate u0 or
/// the ground as a function of time: u - u0 - law(t) = 0. The coordinates are u, u0.
struct DrivenCoordinate : Joint<2, 1> {
  TimeFunction law;

  void constraint_residual(const Coordinates& q, double t, Rows& residual, Gradient& G) const {
    residual[0] = q[0] - q[1] - law(t)[0];
    G << 1, -1;
  }
  /// Returns the partial derivative of the constraint row g with respect to time.
  [[nodiscard]] Rows time_rate(double t) const { return Rows(-law(t)[1]); }
};

/// Linear constraint, sum of factor * coordinate = 0. The coordinates are either all translations
/// or all rotations, because only such constraints are valid in large motion.
struct LinearRow : Joint<Eigen::Dynamic, 1> {
  VectorXd factors;

  void constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
    residual[0] = factors.dot(q);
    G = factors.transpose();
  }
  [[nodiscard]] Rows row_penalty(const TangentCoefficients& coefficients) const {
    return Joint::row_penalty(coefficients) / factors.squaredNorm();
  }
};

/// Spring along the line between two nodes. The row g = |x_b - x_a| - rest length has the
/// compliance c = 1/k; c = 0 is a rigid rod. The coordinates are ua (2), ub (2).
struct LineSpringElement : Joint<4, 1> {
  Vector2d offset = Vector2d::Zero();  ///< x_b - x_a in the pose of the model [m]
  double initial_elongation = 0;       ///< |offset| - rest length [m]
  double flexibility = 0;              ///< compliance 1/k [m/N]

  void constraint_residual(const Coordinates& q, double, Rows& residual, Gradient& G) const {
    const Vector2d relative_displacement = q.tail<2>() - q.head<2>(),
                   current = offset + relative_displacement;
    const double length = current.norm();
    residual[0] =
        relative_displacement.dot(current + offset) / (length + offset.norm()) + initial_elongation;
    G << -current.transpose() / length, current.transpose() / length;
  }
  [[nodiscard]] Square geometric_stiffness(const Coordinates& q, const Rows& lambda) const {
    const Vector2d current = offset + q.tail<2>() - q.head<2>();
    const double length = current.norm();
    const Eigen::Matrix2d k =
        lambda[0] / length *
        (Eigen::Matrix2d::Identity() - current * current.transpose() / (length * length));
    Square K;
    K << k, -k, -k, k;
    return K;
  }
  [[nodiscard]] Gradient discrete_gradient(const Coordinates& q0, const Coordinates& q1) const {
    const Vector2d from = offset + q0.tail<2>() - q0.head<2>();
    const Vector2d to = offset + q1.tail<2>() - q1.head<2>();
    const Vector2d mean = (from + to) / (from.norm() + to.norm());
    Gradient D;
    D << -mean.transpose(), mean.transpose();
    return D;
  }
  [[nodiscard]] Rows row_compliance() const { return Rows::Constant(flexibility); }
};

/// Member without bending stiffness: a line spring with the compliance h/EA. The mass is
/// distributed along the bar, and its displacement is linear between the ends.
struct Bar : LineSpringElement {
  double total_mass = 0;  ///< mass of the bar [kg]
  bool lumped = false;

  [[nodiscard]] Square mass() const {
    const double diagonal = total_mass / (lumped ? 2 : 3), coupling = lumped ? 0 : total_mass / 6;
    const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
    return (Square() << diagonal * I, coupling * I, coupling * I, diagonal * I).finished();
  }
  /// Returns the nodal forces of a distributed load [N/m].
  [[nodiscard]] Coordinates distributed_load(const Vector2d& force_per_length) const {
    return offset.norm() / 2 * force_per_length.replicate<2, 1>();
  }
  [[nodiscard]] Vector2d section_normal(const Coordinates& q, int) const {
    return (offset + q.tail<2>() - q.head<2>()).normalized();
  }
};

/// Linear spring between two coordinates, energy = k (q2 - q1)^2/2.
struct CoordinateSpring : ElementSizes<2, 0> {
  double stiffness = 0;  ///< k [N/m or N m/rad]

  [[nodiscard]] Square stiffness_matrix() const {
    return (Square() << stiffness, -stiffness, -stiffness, stiffness).finished();
  }
  [[nodiscard]] double energy(const Coordinates& q) const {
    return q.dot(stiffness_matrix() * q) / 2;
  }
  [[nodiscard]] Coordinates forces(const Coordinates& q, const Coordinates& v, double tau) const {
    return stiffness_matrix() * (q + tau * v);
  }
  [[nodiscard]] Square tangent(const Coordinates&, double stiffness_factor, double damping) const {
    return (stiffness_factor + damping) * stiffness_matrix();
  }
  [[nodiscard]] Coordinates discrete_gradient_forces(const Coordinates& q0, const Coordinates& q1,
                                                     double damping_over_step) const {
    return forces((q0 + q1) / 2, q1 - q0, damping_over_step);
  }
};

/// Mass or moment of inertia of one coordinate.
struct PointInertia : ElementSizes<1, 0> {
  double value = 0;  ///< mass or moment of inertia [kg or kg m^2]

  [[nodiscard]] Square mass() const { return Square(value); }
};

/// Force [N, N] and moment [N m] that rotate with their node. The coordinates are (ux, uy, theta).
struct FollowerForce : ElementSizes<3, 0> {
  Vector3d force = Vector3d::Zero();  ///< force and moment in the pose of the model

  /// Returns the force, rotated with its node, and the moment for a load factor of 1.
  [[nodiscard]] Coordinates load(const Coordinates& q) const {
    Coordinates f = force;
    f.head<2>() = rotated(force.head<2>(), q[2]);
    return f;
  }
  /// Returns the derivative dload/dq of the load, which is not symmetric.
  [[nodiscard]] Square load_stiffness(const Coordinates& q) const {
    Square derivative = Square::Zero();
    derivative.block<2, 1>(0, 2) = perpendicular(rotated(force.head<2>(), q[2]));
    return derivative;
  }
};

}  // namespace trammel::solver::large_motion
