#include "solver/manipulator/rigid_dynamics.h"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "solver/linalg/dense_eigen.h"
#include "solver/manipulator/kinematics.h"
#include "solver/model/numbers.h"

namespace trammel::solver {

namespace {

template <class S>
using Vec2 = Eigen::Matrix<S, 2, 1>;
template <class S>
using Vec9 = Eigen::Matrix<S, 9, 1>;

// Eigen's dot() conjugates, which is not analytic: a complex step needs the plain sum.
template <class S>
S inner(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.x() + a.y() * b.y();
}
template <class S>
S cross(const Vec2<S>& a, const Vec2<S>& b) {
  return a.x() * b.y() - a.y() * b.x();
}
template <class S>
Vec2<S> perp(const Vec2<S>& a) {
  return {-a.y(), a.x()};
}
template <class S>
Vec2<S> unit(const S& angle) {
  using std::cos;
  using std::sin;
  return {cos(angle), sin(angle)};
}
template <class S>
Vec2<S> rotated(const Vector2d& v, const Vec2<S>& direction) {
  return {direction.x() * v.x() - direction.y() * v.y(),
          direction.y() * v.x() + direction.x() * v.y()};
}

/// The vectors that everything is made of: a, e along proximal and distal links, c = C_i - P.
template <class S>
struct Limb {
  Vec2<S> a, e, c;
  double proximal, distal;
};

template <class S>
Limb<S> limb(const RigidManipulator& m, const Vec9<S>& q, Index i) {
  const auto k = static_cast<std::size_t>(i);
  return {unit(q(i)), unit(q(3 + i)), rotated(m.geometry.platform[k], unit(q(8))),
          m.geometry.proximal[k], m.geometry.distal[k]};
}

/// The platform's circumradius in the mean: what makes its rotation comparable with its
/// translation.
double platform_size(const RigidManipulator& m) {
  double sum = 0;
  for (const Vector2d& c : m.geometry.platform) sum += c.squaredNorm();
  return std::sqrt(sum / 3);
}

/// Solves K X = rhs for the platform's motion, rows of K being (e^T, cross(c, e)).
template <class S>
class PlatformSolver {
 public:
  PlatformSolver(const RigidManipulator& m, const Vec9<S>& q) : size_(platform_size(m)) {
    Eigen::Matrix<S, 3, 3> K;
    for (Index i = 0; i < 3; ++i) {
      const Limb<S> l = limb(m, q, i);
      K.row(i) << l.e.x(), l.e.y(), cross(l.c, l.e) / size_;
    }
    lu_.compute(K);
  }
  [[nodiscard]] Eigen::Matrix<S, 3, 3> solve(const Eigen::Matrix<S, 3, 3>& rhs) const {
    Eigen::Matrix<S, 3, 3> X = lu_.solve(rhs);
    X.row(2) /= size_;
    return X;
  }

 private:
  double size_;
  Eigen::PartialPivLU<Eigen::Matrix<S, 3, 3>> lu_;
};

// Loop closure P + c = A + l1 a + l2 e gives, along e and along perp(e),
//   e . C. = l1 s theta_a.,   perp(e) . C. = l1 (a . e) theta_a. + l2 theta_p.,  s = cross(a, e).
template <class S>
Eigen::Matrix<S, 9, 3> map_from(const RigidManipulator& m, const Vec9<S>& q,
                                const PlatformSolver<S>& solver) {
  Eigen::Matrix<S, 3, 3> D = Eigen::Matrix<S, 3, 3>::Zero();
  for (Index i = 0; i < 3; ++i) {
    const Limb<S> l = limb(m, q, i);
    D(i, i) = l.proximal * cross(l.a, l.e);
  }
  const Eigen::Matrix<S, 3, 3> G = solver.solve(D);
  Eigen::Matrix<S, 9, 3> W;
  W.template topRows<3>().setIdentity();
  W.template bottomRows<3>() = G;
  for (Index i = 0; i < 3; ++i) {
    const Limb<S> l = limb(m, q, i);
    for (Index j = 0; j < 3; ++j) {
      const Vec2<S> velocity = G.col(j).template head<2>() + perp(l.c) * G(2, j);
      W(3 + i, j) = inner(perp(l.e), velocity) / l.distal;
    }
    W(3 + i, i) -= l.proximal * inner(l.a, l.e) / l.distal;
  }
  return W;
}

/// W. : the equations of `map_from` differentiated along q. .
Matrix93d map_rate(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot,
                   const Matrix93d& W, const PlatformSolver<double>& solver) {
  const Matrix3d G = W.bottomRows<3>();
  const double phi_dot = q_dot(8);
  Matrix3d D_dot = Matrix3d::Zero();
  Matrix3d K_dot;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const double p_dot = q_dot(3 + i);
    D_dot(i, i) = l.proximal * inner(l.a, l.e) * (p_dot - q_dot(i));
    K_dot.row(i) << -p_dot * l.e.y(), p_dot * l.e.x(), (p_dot - phi_dot) * inner(l.c, l.e);
  }
  const Matrix3d G_dot = solver.solve(D_dot - K_dot * G);
  Matrix93d W_dot = Matrix93d::Zero();
  W_dot.bottomRows<3>() = G_dot;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const double p_dot = q_dot(3 + i);
    for (Index j = 0; j < 3; ++j) {
      const Vector2d velocity = G.col(j).head<2>() + perp(l.c) * G(2, j);
      const Vector2d acceleration =
          G_dot.col(j).head<2>() + perp(l.c) * G_dot(2, j) - phi_dot * l.c * G(2, j);
      W_dot(3 + i, j) = (inner(perp(l.e), acceleration) - p_dot * inner(l.e, velocity)) / l.distal;
    }
    W_dot(3 + i, i) += l.proximal * cross(l.a, l.e) * (p_dot - q_dot(i)) / l.distal;
  }
  return W_dot;
}

Matrix9d coriolis_matrix(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot) {
  Matrix9d C = Matrix9d::Zero();
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<double> l = limb(m, q, i);
    // Of the coupling m l1 lc cos(theta_a - theta_p) in M.
    const double h = m.distal[k].mass * l.proximal * m.distal[k].center * cross(l.a, l.e);
    C(i, 3 + i) = -h * q_dot(3 + i);
    C(3 + i, i) = h * q_dot(i);
  }
  const Vector2d center = rotated(m.platform.center, unit(q(8)));
  C(6, 8) = -m.platform.mass * center.x() * q_dot(8);
  C(7, 8) = -m.platform.mass * center.y() * q_dot(8);
  return C;
}

Vector9d gravity_vector(const RigidManipulator& m, const Vector9d& q) {
  const Vector2d& g = m.gravity;
  Vector9d N;
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<double> l = limb(m, q, i);
    N(i) = -(m.proximal[k].mass * m.proximal[k].center + m.distal[k].mass * l.proximal) *
           inner(perp(l.a), g);
    N(3 + i) = -m.distal[k].mass * m.distal[k].center * inner(perp(l.e), g);
  }
  const Vector2d center = rotated(m.platform.center, unit(q(8)));
  N.segment<2>(6) = -m.platform.mass * g;
  N(8) = -m.platform.mass * inner(perp(center), g);
  return N;
}

Vector9d coordinates(const Pose& pose, const Posture& posture) {
  Vector9d q;
  for (Index i = 0; i < 3; ++i) {
    q(i) = posture.active[static_cast<std::size_t>(i)];
    q(3 + i) = posture.passive[static_cast<std::size_t>(i)];
  }
  q.tail<3>() << pose.x, pose.y, pose.phi;
  return q;
}

/// Actuator and passive rates from the platform's: `rate` is C. (or C.. with the centripetal
/// terms).
void limb_rates(const RigidManipulator& m, const Vector9d& q, Index i, const Vector2d& rate,
                Vector9d& out) {
  const Limb<double> l = limb(m, q, i);
  out(i) = inner(l.e, rate) / (l.proximal * cross(l.a, l.e));
  out(3 + i) = (inner(perp(l.e), rate) - l.proximal * inner(l.a, l.e) * out(i)) / l.distal;
}

Vector9d velocities(const RigidManipulator& m, const Vector9d& q, const Vector3d& velocity) {
  Vector9d q_dot;
  q_dot.tail<3>() = velocity;
  for (Index i = 0; i < 3; ++i) {
    const Vector2d rate = velocity.head<2>() + velocity(2) * perp(limb(m, q, i).c);
    limb_rates(m, q, i, rate, q_dot);
  }
  return q_dot;
}

Vector9d accelerations(const RigidManipulator& m, const Vector9d& q, const Vector9d& q_dot,
                       const Vector3d& acceleration) {
  Vector9d q_ddot;
  q_ddot.tail<3>() = acceleration;
  for (Index i = 0; i < 3; ++i) {
    const Limb<double> l = limb(m, q, i);
    const Vector2d rate = acceleration.head<2>() + acceleration(2) * perp(l.c) -
                          q_dot(8) * q_dot(8) * l.c + l.proximal * q_dot(i) * q_dot(i) * l.a +
                          l.distal * q_dot(3 + i) * q_dot(3 + i) * l.e;
    limb_rates(m, q, i, rate, q_ddot);
  }
  return q_ddot;
}

/// A point at the vector r on a body that turns, carried by a point that moves.
BodyMotion carried(const BodyMotion& carrier, const Vector2d& r, double angle, double omega,
                   double alpha) {
  return {carrier.position + r,
          carrier.velocity + omega * perp(r),
          carrier.acceleration + alpha * perp(r) - omega * omega * r,
          angle,
          omega,
          alpha};
}

std::array<BodyMotion, 7> body_motions(const RigidManipulator& m, const Vector9d& q,
                                       const Vector9d& v, const Vector9d& w) {
  std::array<BodyMotion, 7> bodies;
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<double> l = limb(m, q, i);
    const Index p = 3 + i;
    const BodyMotion base{m.geometry.base[k], Vector2d::Zero(), Vector2d::Zero()};
    const BodyMotion elbow = carried(base, l.proximal * l.a, q(i), v(i), w(i));
    bodies[k] = carried(base, m.proximal[k].center * l.a, q(i), v(i), w(i));
    bodies[3 + k] = carried(elbow, m.distal[k].center * l.e, q(p), v(p), w(p));
  }
  const BodyMotion P{q.segment<2>(6), v.segment<2>(6), w.segment<2>(6)};
  bodies[6] = carried(P, rotated(m.platform.center, unit(q(8))), q(8), v(8), w(8));
  return bodies;
}

Outcome state_outcome(const Posture& posture, const ManipulatorGeometry& geometry,
                      const Pose& pose) {
  if (!posture.outcome.solved()) return posture.outcome;
  const Jacobians j = jacobians(geometry, pose, posture);
  if (!(j.parallel_distance > kSingularRatio))
    return {Status::singular,
            "a parallel singularity: the actuators do not determine the platform's motion"};
  if (!(j.serial_distance > kSingularRatio))
    return {Status::singular,
            "a serial singularity: a limb is straight or folded and its actuator does not follow "
            "from the platform's motion"};
  return {};
}

void set_nan(RigidTerms& t) {
  t.q.setConstant(kNaN);
  t.q_dot.setConstant(kNaN);
  t.M.setConstant(kNaN);
  t.C.setConstant(kNaN);
  t.N.setConstant(kNaN);
  t.W.setConstant(kNaN);
  t.W_dot.setConstant(kNaN);
  t.Mh.setConstant(kNaN);
  t.Ch.setConstant(kNaN);
  t.Nh.setConstant(kNaN);
}

void set_nan(InverseDynamics& d) {
  d.q.setConstant(kNaN);
  d.q_dot.setConstant(kNaN);
  d.q_ddot.setConstant(kNaN);
  const Vector2d none = Vector2d::Constant(kNaN);
  d.bodies.fill({none, none, none, kNaN, kNaN, kNaN});
  d.torque.setConstant(kNaN);
  d.kinetic_energy = d.kinetic_power = d.actuator_power = d.load_power = d.gravity_power = kNaN;
}

void add_powers(const RigidManipulator& m, InverseDynamics& result) {
  const auto add = [&](const BodyMotion& b, double mass, double inertia) {
    result.kinetic_energy +=
        (mass * b.velocity.squaredNorm() + inertia * b.angular_velocity * b.angular_velocity) / 2;
    result.kinetic_power += mass * inner(b.velocity, b.acceleration) +
                            inertia * b.angular_velocity * b.angular_acceleration;
    result.gravity_power += mass * inner(m.gravity, b.velocity);
  };
  for (std::size_t k = 0; k < 3; ++k) {
    add(result.bodies[k], m.proximal[k].mass, m.proximal[k].inertia);
    add(result.bodies[3 + k], m.distal[k].mass, m.distal[k].inertia);
  }
  add(result.bodies[6], m.platform.mass, m.platform.inertia);
}

RigidLink rigid_link(const LinkDesign& link, double length) {
  const double mass = link_section(link, length).mass_per_length * length;
  return {mass, length / 2, link.inertia.value_or(mass * length * length / 12)};
}

}  // namespace

RigidManipulator rigid_manipulator(const ManipulatorDesign& design) {
  check_geometry(design.geometry);
  RigidManipulator m;
  m.geometry = design.geometry;
  for (std::size_t k = 0; k < 3; ++k) {
    m.proximal[k] = rigid_link(design.proximal[k], design.geometry.proximal[k]);
    m.distal[k] = rigid_link(design.distal[k], design.geometry.distal[k]);
  }
  m.platform = platform_mass(design);
  return m;
}

template <class S>
Eigen::Matrix<S, 9, 9> mass_matrix(const RigidManipulator& m, const Eigen::Matrix<S, 9, 1>& q) {
  Eigen::Matrix<S, 9, 9> M = Eigen::Matrix<S, 9, 9>::Zero();
  for (Index i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Limb<S> l = limb(m, q, i);
    const RigidLink& p = m.proximal[k];
    const RigidLink& d = m.distal[k];
    M(i, i) = p.inertia + p.mass * p.center * p.center + d.mass * l.proximal * l.proximal;
    M(3 + i, 3 + i) = d.inertia + d.mass * d.center * d.center;
    M(i, 3 + i) = M(3 + i, i) = d.mass * l.proximal * d.center * inner(l.a, l.e);
  }
  const PlatformMass& platform = m.platform;
  const Vec2<S> lever = perp(rotated(platform.center, unit(q(8))));
  M(6, 6) = M(7, 7) = platform.mass;
  M(6, 8) = M(8, 6) = platform.mass * lever.x();
  M(7, 8) = M(8, 7) = platform.mass * lever.y();
  M(8, 8) = platform.inertia + platform.mass * platform.center.squaredNorm();
  return M;
}

template <class S>
Eigen::Matrix<S, 9, 3> motion_map(const RigidManipulator& m, const Eigen::Matrix<S, 9, 1>& q) {
  return map_from(m, q, PlatformSolver<S>(m, q));
}

template <class S>
Eigen::Matrix<S, 3, 3> reduced_mass(const RigidManipulator& m, const Eigen::Matrix<S, 9, 1>& q) {
  const Eigen::Matrix<S, 9, 3> W = motion_map(m, q);
  return W.transpose() * mass_matrix(m, q) * W;
}

template Eigen::Matrix<double, 9, 9> mass_matrix(const RigidManipulator&,
                                                 const Eigen::Matrix<double, 9, 1>&);
template Eigen::Matrix<double, 9, 3> motion_map(const RigidManipulator&,
                                                const Eigen::Matrix<double, 9, 1>&);
template Eigen::Matrix<double, 3, 3> reduced_mass(const RigidManipulator&,
                                                  const Eigen::Matrix<double, 9, 1>&);
using Complex = std::complex<double>;
template Eigen::Matrix<Complex, 9, 9> mass_matrix(const RigidManipulator&,
                                                  const Eigen::Matrix<Complex, 9, 1>&);
template Eigen::Matrix<Complex, 9, 3> motion_map(const RigidManipulator&,
                                                 const Eigen::Matrix<Complex, 9, 1>&);
template Eigen::Matrix<Complex, 3, 3> reduced_mass(const RigidManipulator&,
                                                   const Eigen::Matrix<Complex, 9, 1>&);

RigidTerms rigid_terms(const RigidManipulator& m, const Pose& pose, const Vector3d& velocity) {
  RigidTerms terms;
  const Posture posture = inverse_kinematics(m.geometry, pose);
  terms.outcome = state_outcome(posture, m.geometry, pose);
  if (!terms.outcome.solved()) {
    set_nan(terms);
    return terms;
  }
  terms.q = coordinates(pose, posture);
  terms.q_dot = velocities(m, terms.q, velocity);
  const PlatformSolver<double> solver(m, terms.q);
  terms.M = mass_matrix<double>(m, terms.q);
  terms.C = coriolis_matrix(m, terms.q, terms.q_dot);
  terms.N = gravity_vector(m, terms.q);
  terms.W = map_from(m, terms.q, solver);
  terms.W_dot = map_rate(m, terms.q, terms.q_dot, terms.W, solver);
  terms.Mh = terms.W.transpose() * terms.M * terms.W;
  terms.Ch = terms.W.transpose() * (terms.M * terms.W_dot + terms.C * terms.W);
  terms.Nh = terms.W.transpose() * terms.N;
  return terms;
}

PropertyResiduals property_residuals(const RigidManipulator& m, const RigidTerms& terms) {
  constexpr double h = 1e-30;  // so small that no rounding sees it: the step is exact
  Eigen::Matrix<Complex, 9, 1> q;
  for (Index i = 0; i < 9; ++i) q(i) = {terms.q(i), h * terms.q_dot(i)};
  const Matrix3d Mh_dot = reduced_mass<Complex>(m, q).imag() / h;
  const Matrix3d S = Mh_dot - 2 * terms.Ch;
  const double scale = Mh_dot.norm() + 2 * terms.Ch.norm();
  return {(terms.Mh - terms.Mh.transpose()).norm() / terms.Mh.norm(),
          scale > 0 ? (S + S.transpose()).norm() / scale : 0,
          symmetric_eigenpairs(terms.Mh).value(0)};
}

InverseDynamics inverse_dynamics(const RigidManipulator& m, const TrajectoryPoint& motion,
                                 const Vector3d& wrench) {
  InverseDynamics result;
  const RigidTerms terms = rigid_terms(m, motion.pose, motion.velocity);
  result.outcome = terms.outcome;
  if (!result.outcome.solved()) {
    set_nan(result);
    return result;
  }
  result.q = terms.q;
  result.q_dot = terms.q_dot;
  result.q_ddot = accelerations(m, terms.q, terms.q_dot, motion.acceleration);
  result.bodies = body_motions(m, result.q, result.q_dot, result.q_ddot);
  result.torque = terms.Mh * result.q_ddot.head<3>() + terms.Ch * result.q_dot.head<3>() +
                  terms.Nh - terms.W.bottomRows<3>().transpose() * wrench;
  add_powers(m, result);
  result.actuator_power = result.torque.dot(result.q_dot.head<3>());
  result.load_power = wrench.dot(motion.velocity);
  return result;
}

}  // namespace trammel::solver
