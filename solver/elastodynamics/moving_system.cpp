#include "solver/elastodynamics/moving_system.h"

#include <algorithm>

#include "solver/assembly/strain.h"
#include "solver/model/plane.h"

namespace trammel::solver {

namespace {

using Eigen::VectorXd;

NominalMotion motion_at_start(const Model& model) {
  NominalMotion motion;
  const auto nodes = static_cast<Index>(model.nodes.size());
  motion.position.resize(nodes, 2);
  for (Index i = 0; i < nodes; ++i) motion.position.row(i) = model.nodes[to_size(i)].position;
  motion.acceleration.setZero(nodes, 2);
  motion.member.resize(model.members.size());
  motion.plate.resize(model.plates.size());
  motion.rigid_body.resize(model.rigid_bodies.size());
  return motion;
}

/// int rho W^T (2 W. u. + W.. u) dV by the rotation of the element's own part.
Vector6d turning_inertia(const MovingElement& element, const PartMotion& part, const Vector6d& u,
                         const Vector6d& velocity) {
  const Matrix6d first = element.rotated(element.first_derivative, part.angle);
  const Matrix6d second = element.rotated(element.second_derivative, part.angle);
  return 2 * part.rate * (first * velocity) + part.acceleration * (first * u) +
         part.rate * part.rate * (second * u);
}

}  // namespace

MovingSystem::MovingSystem(const Model& model, bool gyroscopic, bool inertia)
    : start_(assemble(model, inertia ? Effects::all() : Effects::all().without(Effect::inertia))),
      gyroscopic_(gyroscopic),
      inertia_(inertia),
      motion_(motion_at_start(model)),
      constraints_(start_, motion_, gyroscopic),
      elements_(moving_elements(start_)),
      pattern_(elements_, constraints_.T()),
      interpolation_(start_),
      K_(pattern_.matrix) {
  if (inertia_) M_ = K_;
  if (gyroscopic_) C_gyroscopic_ = K_centrifugal_euler_ = K_T_dot_ = M_T_dot_ = K_;
  inertia_u_.setZero(start_.coordinates.size);
  inertia_load_.setZero(K_.rows());
  load_.setZero(K_.rows());
  static_cast<void>(move_to(NominalMotion(motion_)));
}

/// The element's share of r..: an affine field, which the interpolation holds exactly.
Vector6d MovingSystem::nominal_acceleration(const MovingElement& element) const {
  Vector6d a = Vector6d::Zero();
  const double alpha = element.motion(motion_).acceleration;
  for (Index i = 0; i < 6; ++i) {
    const Index u = element.coordinates[static_cast<std::size_t>(i)];
    if (u < 0) continue;
    const Index component =
        element.layout == MovingElement::Layout::scalar ? 2 : i % element.stride();
    if (component == 2) {
      a[i] = alpha;
      continue;
    }
    a[i] =
        interpolation_.at(start_.coordinates.node_of[to_size(u)], motion_.acceleration)[component];
  }
  return a;
}

Vector6d MovingSystem::weight(const MovingElement& element, const Matrix6d& m) const {
  Vector6d g = Vector6d::Zero();
  if (element.layout == MovingElement::Layout::scalar || motion_.gravity.isZero(0)) return g;
  for (Index i = 0; i + 1 < 6; i += element.stride()) g.segment<2>(i) = motion_.gravity;
  return m * g;
}

/// Load of nominal inertia on the element, with the centripetal part of a mass off its node.
Vector6d MovingSystem::element_inertia_load(const MovingElement& element, const Matrix6d& m) const {
  Vector6d f = -m * nominal_acceleration(element);
  if (element.layout == MovingElement::Layout::point_mass) {
    const PartMotion part = element.motion(motion_);
    f.head<2>() += part.rate * part.rate * rotated(element.first_moment, part.angle);
  }
  return f;
}

Outcome MovingSystem::move_to(const NominalMotion& motion) {
  const Outcome outcome = constraints_.move(start_, motion_, motion);
  if (!outcome.solved()) return outcome;
  motion_ = motion;
  std::fill_n(K_.valuePtr(), K_.nonZeros(), 0.0);
  if (inertia_) std::fill_n(M_.valuePtr(), M_.nonZeros(), 0.0);
  if (gyroscopic_) {
    for (SparseMatrix* A : {&C_gyroscopic_, &K_centrifugal_euler_, &K_T_dot_, &M_T_dot_})
      std::fill_n(A->valuePtr(), K_.nonZeros(), 0.0);
  }
  inertia_u_.setZero();
  load_u_ = motion_.load_factor * start_.load;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const MovingElement& element = elements_[e];
    const PartMotion part = element.motion(motion_);
    const Matrix6d m = element.rotated(element.m, part.angle);
    const Matrix6d k = element.rotated(element.k, part.angle);
    add_stiffness_and_mass(e, k, m);
    if (gyroscopic_) add_gyroscopic(e, part, k, m);
    const Vector6d f = element_inertia_load(element, m);
    const Vector6d w = weight(element, m);
    for (Index i = 0; i < 6; ++i) {
      const Index u = element.coordinates[static_cast<std::size_t>(i)];
      if (u < 0) continue;
      inertia_u_[u] += f[i];
      load_u_[u] += w[i];
    }
  }
  inertia_load_.noalias() = constraints_.T().transpose() * inertia_u_;
  load_.noalias() = constraints_.T().transpose() * load_u_;
  return {};
}

void MovingSystem::add_stiffness_and_mass(std::size_t index, const Matrix6d& k, const Matrix6d& m) {
  const double* const T = constraints_.T().valuePtr();
  for (std::size_t t = pattern_.first[index]; t < pattern_.first[index + 1]; ++t) {
    const MovingPattern::Contribution& contribution = pattern_.contributions[t];
    const double factor = T[contribution.a] * T[contribution.b];
    K_.valuePtr()[contribution.destination] += factor * k(contribution.local);
    if (inertia_) M_.valuePtr()[contribution.destination] += factor * m(contribution.local);
  }
}

void MovingSystem::add_gyroscopic(std::size_t index, const PartMotion& part, const Matrix6d& k,
                                  const Matrix6d& m) {
  const MovingElement& element = elements_[index];
  const Matrix6d first_derivative = element.rotated(element.first_derivative, part.angle);
  const Matrix6d second_derivative = element.rotated(element.second_derivative, part.angle);
  const Matrix6d c = 2 * part.rate * first_derivative;
  const Matrix6d s =
      part.acceleration * first_derivative + part.rate * part.rate * second_derivative;
  const double* const T = constraints_.T().valuePtr();
  for (std::size_t t = pattern_.first[index]; t < pattern_.first[index + 1]; ++t) {
    const MovingPattern::Contribution& contribution = pattern_.contributions[t];
    const double a = T[contribution.a];
    const double b = T[contribution.b];
    const double b_dot =
        constraints_.variable() ? constraints_.T_dot().valuePtr()[contribution.b] : 0;
    const double b_ddot =
        constraints_.variable() ? constraints_.T_ddot().valuePtr()[contribution.b] : 0;
    C_gyroscopic_.valuePtr()[contribution.destination] +=
        a * (2 * m(contribution.local) * b_dot + c(contribution.local) * b);
    K_centrifugal_euler_.valuePtr()[contribution.destination] +=
        a * (m(contribution.local) * b_ddot + c(contribution.local) * b_dot +
             s(contribution.local) * b);
    K_T_dot_.valuePtr()[contribution.destination] += a * k(contribution.local) * b_dot;
    M_T_dot_.valuePtr()[contribution.destination] += a * m(contribution.local) * b_dot;
  }
}

VectorXd MovingSystem::velocity(const VectorXd& q, const VectorXd& v) const {
  VectorXd u_dot = constraints_.T() * v;
  if (gyroscopic_ && constraints_.variable()) u_dot += constraints_.T_dot() * q;
  return u_dot;
}

MovingSystem::ElasticMotion MovingSystem::elastic_motion(const VectorXd& q,
                                                         const VectorXd& v) const {
  ElasticMotion motion{.u = constraints_.T() * q,
                       .velocity = velocity(q, v),
                       .Ku = VectorXd::Zero(load_u_.size()),
                       .Kv = VectorXd::Zero(load_u_.size()),
                       .Mv = VectorXd::Zero(load_u_.size()),
                       .load = load_u_,
                       .inertia = inertia_u_};
  for (const MovingElement& element : elements_) {
    const double angle = element.motion(motion_).angle;
    const Matrix6d k = element.rotated(element.k, angle);
    const Vector6d v_e = detail::gather(element.coordinates, motion.velocity);
    const Vector6d Ku = k * detail::gather(element.coordinates, motion.u);
    const Vector6d Kv = k * v_e;
    const Vector6d Mv = element.rotated(element.m, angle) * v_e;
    for (Index i = 0; i < 6; ++i) {
      const Index c = element.coordinates[to_size(i)];
      if (c < 0) continue;
      motion.Ku[c] += Ku[i];
      motion.Kv[c] += Kv[i];
      motion.Mv[c] += Mv[i];
    }
  }
  return motion;
}

MovingSystem::Forces MovingSystem::forces(const VectorXd& q, const VectorXd& v, const VectorXd& a,
                                          double mass_damping, double stiffness_damping,
                                          bool with_inertia) const {
  const auto& T = constraints_.T();
  const VectorXd u = T * q;
  const VectorXd u_dot = velocity(q, v);
  VectorXd u_ddot = T * a + mass_damping * u_dot;
  if (gyroscopic_ && constraints_.variable()) {
    u_ddot += 2 * (constraints_.T_dot() * v) + constraints_.T_ddot() * q;
  }
  Forces forces;
  forces.element.setZero(6, static_cast<Index>(start_.mesh.frame.size()));
  forces.external = motion_.load_factor * start_.load;
  forces.total = -forces.external;
  const VectorXd strained = u + stiffness_damping * u_dot;
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    const MovingElement& element = elements_[e];
    const PartMotion part = element.motion(motion_);
    const Matrix6d m = element.rotated(element.m, part.angle);
    Vector6d inertia = m * detail::gather(element.coordinates, u_ddot);
    if (gyroscopic_) {
      inertia += turning_inertia(element, part, detail::gather(element.coordinates, u),
                                 detail::gather(element.coordinates, u_dot));
    }
    if (with_inertia) inertia -= element_inertia_load(element, m);
    inertia -= weight(element, m);
    const Vector6d f =
        element.rotated(element.k, part.angle) * detail::gather(element.coordinates, strained) +
        inertia;
    for (Index i = 0; i < 6; ++i) {
      const Index c = element.coordinates[static_cast<std::size_t>(i)];
      if (c < 0) continue;
      forces.total[c] += f[i];
      forces.external[c] -= inertia[i];
    }
    if (element.layout != MovingElement::Layout::frame) continue;
    const FrameElement& frame = start_.mesh.frame[e];  // the frame elements come first
    forces.element.col(static_cast<Index>(e)) =
        frame_rotation(rotated(frame.direction, part.angle)) * f;
  }
  return forces;
}

}  // namespace trammel::solver
