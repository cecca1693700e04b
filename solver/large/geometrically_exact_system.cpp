#include "solver/large/geometrically_exact_system.h"

#include <utility>

#include "solver/model/model.h"

namespace trammel::solver::large_motion {

namespace {

/// Returns the diagonal of the bounding box of all nodes and centers of mass [m].
double model_size(const Model& model) {
  std::vector<Vector2d> points;
  for (const Node& node : model.nodes) points.push_back(node.position);
  for (const PointMass& mass : model.masses)
    points.push_back(points[to_size(mass.node)] + mass.offset);
  return box_diagonal(points);
}

/// Returns the reference value of each free coordinate: the model size [m] for translations, 1 rad
/// for rotations.
VectorXd coordinate_scales(const Model& model, const Layout& layout) {
  const double size = model_size(model);
  VectorXd scale(layout.free);
  for (Index i = 0; i < layout.free; ++i) scale[i] = layout.is_rotation(i) ? 1.0 : size;
  return scale;
}

/// Returns gravity at every translation and zero at rotations [m/s^2]. The weight is M times this
/// field.
VectorXd gravity_field(const Model& model, const Layout& layout) {
  VectorXd field = VectorXd::Zero(layout.total);
  for (Index k = 0; k < layout.total; ++k) {
    if (!layout.is_rotation(k)) field[k] = model.gravity[layout.direction[to_size(k)]];
  }
  return field;
}

}  // namespace

GeometricallyExactSystem::GeometricallyExactSystem(Model model, LargeMotionModel large_motion)
    : model_(std::move(model)),
      large_motion_(std::move(large_motion)),
      parts_(build_parts(model_, large_motion_, layout_)),
      rows_{{}, VectorXd::Zero(parts_.rows), VectorXd::Ones(parts_.rows)},
      scale_(coordinate_scales(model_, layout_)),
      mass_(layout_.total, layout_.total),
      padded_(VectorXd::Zero(layout_.total)),
      product_(VectorXd::Zero(layout_.total)) {
  std::vector<Eigen::Triplet<double>> masses;
  parts_.for_each_group([&](const auto& group) { group.append_masses(masses); });
  mass_.setFromTriplets(masses.begin(), masses.end());
  gravity_ = mass_ * gravity_field(model_, layout_);
  const PenaltyScales scales(model_, large_motion_, layout_, mass_.diagonal(), model_size(model_));
  parts_.for_each_group(
      [&](auto& group) { group.append_system_rows(layout_.free, scales, rows_); });
}

void GeometricallyExactSystem::force_residual(const State& state, Eigen::Ref<VectorXd> r) const {
  const Index n = layout_.free, size = r.size();
  r = -state.gravity * gravity_.head(size) - state.load * parts_.loads.head(size);
  if (state.a.size() == n) {
    padded_.head(n) = state.a;
    if (large_motion_.mass_damping != 0)
      padded_.head(n) += large_motion_.mass_damping * damped_velocities(state);
    product_.noalias() = mass_ * padded_;
    r += product_.head(size);
  }
  add_torques(-1, state.t, r);
  parts_.for_each_group(
      [&](const auto& group) { group.add_forces(state, large_motion_.strain_rate_damping, r); });
}

VectorXd GeometricallyExactSystem::damped_velocities(const State& state) const {
  if (!undamped_velocities_) return state.v;
  return state.v - undamped_velocities_(state.t);
}

void GeometricallyExactSystem::set_load_factor(State& state, double load_factor) const {
  state.t = state.load = state.gravity = load_factor;
  if (accelerations_.size() > 0) state.a = load_factor * accelerations_;
}

void GeometricallyExactSystem::add_torques(double factor, double t, Eigen::Ref<VectorXd> r) const {
  for (const Torque& torque : large_motion_.torques) {
    const Index coordinate = layout_.node[to_size(torque.node)][2];
    if (coordinate < r.size()) r[coordinate] += factor * torque.law(t);
  }
}

void GeometricallyExactSystem::constraint_residual(const State& state,
                                                   Eigen::Ref<VectorXd> residual,
                                                   Eigen::Ref<VectorXd> rate) const {
  parts_.for_each_group(
      [&](const auto& group) { group.constraint_residual(state, residual, rate); });
}

TangentCoefficients GeometricallyExactSystem::prepare_tangent(
    TangentCoefficients coefficients) const {
  element_evaluations_ += std::ssize(layout_.elements) + std::ssize(model_.triangles);
  coefficients.mass += large_motion_.mass_damping * coefficients.damping;
  return coefficients;
}

void GeometricallyExactSystem::add_tangent(const State& state,
                                           const TangentCoefficients& coefficients,
                                           KktMatrix& matrix) const {
  const TangentCoefficients damped = prepare_tangent(coefficients);
  parts_.for_each_group([&](const auto& group) {
    group.add_tangent(state, large_motion_.strain_rate_damping, damped, matrix);
  });
}

void GeometricallyExactSystem::discrete_gradient_tangent(const State& from, const State& to,
                                                         const State& midpoint,
                                                         const TangentCoefficients& coefficients,
                                                         KktMatrix& matrix) const {
  const TangentCoefficients damped = prepare_tangent(coefficients);
  parts_.for_each_group([&](const auto& group) {
    group.discrete_gradient_tangent(from, to, midpoint, large_motion_.strain_rate_damping, damped,
                                    matrix);
  });
}

void GeometricallyExactSystem::discrete_gradient_residual(const State& from, const State& to,
                                                          const VectorXd& lambda,
                                                          Eigen::Ref<VectorXd> r) const {
  const Index n = layout_.free, size = r.size();
  const double h = to.t - from.t;
  r = -(from.gravity + to.gravity) / 2 * gravity_.head(size) -
      (from.load + to.load) / 2 * parts_.loads.head(size);
  padded_.head(n) = (to.v - from.v) / h + large_motion_.mass_damping * (from.v + to.v) / 2;
  product_.noalias() = mass_ * padded_;
  r += product_.head(size);
  for (const double t : {from.t, to.t}) add_torques(-0.5, t, r);
  parts_.for_each_group([&](const auto& group) {
    group.discrete_gradient_forces(from, to, lambda, large_motion_.strain_rate_damping, r);
  });
}

bool GeometricallyExactSystem::has_symmetric_tangent() const {
  return large_motion_.follower_loads.empty();
}

double GeometricallyExactSystem::load_factor(double t) const {
  return large_motion_.load_history ? large_motion_.load_history(t) : 1.0;
}

Energy GeometricallyExactSystem::energy(const State& state) const {
  Energy energy;
  const Index n = layout_.free;
  if (state.v.size() == n) {
    padded_.head(n) = state.v;
    product_.noalias() = mass_ * padded_;
    energy.kinetic = product_.head(n).dot(state.v) / 2;
  }
  parts_.for_each_group([&](const auto& group) { energy.strain += group.energy(state); });
  VectorXd residual = VectorXd::Zero(parts_.rows), rate = VectorXd::Zero(parts_.rows);
  constraint_residual(state, residual, rate);
  for (Index i = 0; i < parts_.rows; ++i) {
    if (rows_.compliance[i] > 0)
      energy.strain += residual[i] * residual[i] / (2 * rows_.compliance[i]);
  }
  energy.load = -state.q.dot(state.gravity * gravity_.head(n) + state.load * parts_.loads.head(n));
  return energy;
}

double GeometricallyExactSystem::nonconservative_work(const State& from, const State& to,
                                                      const VectorXd& lambda) const {
  const Index n = layout_.free;
  const double h = to.t - from.t;
  const VectorXd moved = to.q - from.q;
  const auto mean = (from.q + to.q) / 2;
  double work = -mean.dot((to.gravity - from.gravity) * gravity_.head(n) +
                          (to.load - from.load) * parts_.loads.head(n));
  padded_.head(n) = (from.v + to.v) / 2;
  product_.noalias() = mass_ * padded_;
  work -= h * large_motion_.mass_damping * padded_.head(n).dot(product_.head(n));
  // The residuals of constraint rows change in a step by the motion and by the drives. Constraint
  // forces do work only on the change by the motion, which is computed with the drives held at the
  // start time.
  VectorXd before = VectorXd::Zero(parts_.rows), after = before, rate = before;
  State held = to;
  held.t = from.t;
  constraint_residual(from, before, rate);
  constraint_residual(held, after, rate);
  const double tau = large_motion_.strain_rate_damping;
  for (Index i = 0; i < parts_.rows; ++i) {
    const double change = after[i] - before[i];
    work -= rows_.compliance[i] > 0 ? tau / h * change * change / rows_.compliance[i]
                                    : lambda[i] * change;
  }
  VectorXd forces = VectorXd::Zero(n), elastic = forces;
  for (const double t : {from.t, to.t}) add_torques(-0.5, t, forces);
  parts_.group<FollowerForce>().discrete_gradient_forces(from, to, lambda, 0, forces);
  if (tau != 0) {
    parts_.for_each_group([&](const auto& group) {
      group.discrete_gradient_forces(from, to, lambda, tau, forces);
      group.discrete_gradient_forces(from, to, lambda, 0, elastic);
    });
  }
  return work - moved.dot(forces - elastic);
}

void GeometricallyExactSystem::load_factor_derivative(const State& state,
                                                      Eigen::Ref<VectorXd> r) const {
  r = -gravity_.head(r.size()) - parts_.loads.head(r.size());
  if (accelerations_.size() > 0) {
    padded_.head(layout_.free) = accelerations_;
    product_.noalias() = mass_ * padded_;
    r += product_.head(r.size());
  }
  parts_.group<FollowerForce>().add_load_derivative(state, r);
}

State GeometricallyExactSystem::reference_state() const {
  State state;
  state.q = state.v = state.a = VectorXd::Zero(layout_.free);
  state.lambda = VectorXd::Zero(parts_.rows);
  return state;
}

}  // namespace trammel::solver::large_motion
