#include "solver/large/equilibrium.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "solver/large/state_results.h"
#include "solver/large/static_path.h"
#include "solver/linalg/dense_eigen.h"

namespace trammel::solver::large_motion {

void apply_correction(State& state, const VectorXd& step, double factor) {
  state.q += factor * step.head(state.q.size());
  state.lambda += factor * step.segment(state.q.size(), state.lambda.size());
}

Equilibrium::Equilibrium(const GeometricallyExactSystem& system, const NewtonOptions& options)
    : system_(system),
      options_(options),
      matrix_(system.coordinate_count(), system.constraint_count(), system.coupled_unknowns()),
      constraint_residual_(VectorXd::Zero(system.constraint_count())),
      constraint_rate_(VectorXd::Zero(system.constraint_count())),
      step_(VectorXd::Zero(system.coordinate_count() + system.constraint_count())),
      force_unit_(system.row_units().cwiseInverse()) {}

bool Equilibrium::converged(const std::vector<double>& correction, double displacement) const {
  const std::size_t count = correction.size();
  const double last = correction[count - 1];
  // Corrections and displacements are relative to the model size. Newton's method converges
  // quadratically: the remaining error is about the square of the last correction. The absolute
  // limit 1e-15 is therefore sufficient even for displacements that are much smaller than the model
  // size.
  if (last <= options_.tolerance * displacement + 1e-15) return true;
  // Near a bifurcation, corrections stagnate at the round-off error divided by the small stiffness.
  return count > 1 && last < 1e-8 * displacement + 1e-11 && last > 0.3 * correction[count - 2];
}

bool Equilibrium::factorize_tangent(const State& state) {
  matrix_.clear();
  system_.add_tangent(state, TangentCoefficients{}, matrix_);
  for (const auto& [k, stiffness] : held_) matrix_.add_diagonal(k, stiffness);
  const bool regular = matrix_.factor(system_.has_symmetric_tangent());
  factored_ = regular ? state : State();
  return regular;
}

bool Equilibrium::factor_if_moved(const State& state, double relative) {
  const bool same = factored_.q.size() == state.q.size() &&
                    weighted_rms_norm(system_, state.q - factored_.q) <=
                        relative * weighted_rms_norm(system_, state.q) &&
                    (state.lambda - factored_.lambda).cwiseQuotient(force_unit_).norm() <=
                        relative * state.lambda.cwiseQuotient(force_unit_).norm() &&
                    std::abs(state.load - factored_.load) <= relative * std::abs(state.load);
  return same || factorize_tangent(state);
}

void Equilibrium::residual_of(const State& state, Eigen::Ref<VectorXd> residual) {
  const Index n = system_.coordinate_count();
  system_.force_residual(state, residual.head(n));
  system_.constraint_residual(state, constraint_residual_, constraint_rate_);
  residual.tail(system_.constraint_count()) =
      constraint_residual_ - system_.row_compliance().cwiseProduct(state.lambda);
  const double tau = system_.strain_rate_damping();
  for (Index row = 0; tau != 0 && row < system_.constraint_count(); ++row)
    if (system_.row_compliance()[row] > 0) residual[n + row] += tau * constraint_rate_[row];
  if (held_damping_.size() > 0) residual += held_damping_;
}

void Equilibrium::freeze_damping_forces(const State& moving) {
  State still = moving;
  still.v.setZero(system_.coordinate_count());
  VectorXd damped(step_.size()), undamped(step_.size());
  held_damping_.resize(0);
  residual_of(moving, damped);
  residual_of(still, undamped);
  held_damping_ = damped - undamped;
}

void Equilibrium::newton_correction(const State& state, VectorXd& step, NewtonResult& history) {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  step.resize(n + m);
  residual_of(state, step);
  history.force_residual.push_back(n > 0 ? step.head(n).cwiseProduct(system_.scale()).norm() : 0.0);
  history.constraint_residual.push_back(step.tail(m).norm());
  step = -step;
  matrix_.solve(step);
  history.correction.push_back(weighted_rms_norm(system_, step.head(n)));
}

void Equilibrium::load_factor_sensitivity(const State& state, VectorXd& direction) {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  direction.resize(n + m);
  system_.load_factor_derivative(state, direction.head(n));
  State at_rest = state;
  at_rest.v.setZero(n);
  system_.constraint_residual(at_rest, constraint_residual_, constraint_rate_);
  direction.tail(m) = constraint_rate_;
  direction = -direction;
  matrix_.solve(direction);
}

double Equilibrium::backward_error(const State& state) {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  VectorXd x(n + m), residual(n + m), load(n);
  const VectorXd motion = state.q.head(n).cwiseQuotient(system_.scale()).cwiseAbs();
  const double largest_motion = n > 0 ? motion.maxCoeff() : 0;
  const VectorXd force = state.lambda.cwiseQuotient(force_unit_).cwiseAbs();
  const double largest_force = m > 0 ? force.maxCoeff() : 0;
  x.head(n) = motion.cwiseMax(kLeastFraction * largest_motion).cwiseProduct(system_.scale());
  x.tail(m) = force.cwiseMax(kLeastFraction * largest_force).cwiseProduct(force_unit_);
  matrix_.clear();
  system_.add_tangent(state, TangentCoefficients{}, matrix_);
  VectorXd terms(n + m);
  matrix_.term_magnitudes(x, terms);
  system_.load_factor_derivative(state, load);
  terms.head(n) += std::abs(state.load) * load.cwiseAbs();
  residual_of(state, residual);
  return row_backward_error(residual, terms);
}

double Equilibrium::smallest_eigenpair(VectorXd& shape) {
  const Index n = system_.coordinate_count(), m = system_.constraint_count();
  if (n == 0) return 0;
  // The start vector of the inverse iteration has no symmetry, so that it is not orthogonal to any
  // mode.
  VectorXd x(n + m);
  for (Index i = 0; i < n; ++i)
    x[i] = system_.scale()[i] * (1 + 0.37 * std::sin(1.7 * static_cast<double>(i) + 0.4));
  double eigenvalue = 0;
  for (int pass = 0; pass < 12; ++pass) {
    const double norm = x.head(n).cwiseQuotient(system_.scale()).norm();
    x.head(n) = (x.head(n) / norm).cwiseQuotient(system_.scale().cwiseAbs2());
    x.tail(m).setZero();
    matrix_.solve(x);
    const double next = 1 / x.head(n).cwiseQuotient(system_.scale()).norm();
    const bool converged = std::abs(next - eigenvalue) < 1e-10 * next;
    eigenvalue = next;
    if (converged) break;
  }
  shape = x.head(n) * eigenvalue;
  return eigenvalue;
}

Equilibrium::FreeMotion Equilibrium::free_motion(const State& state) {
  constexpr double kDriven = 1e-9;  // least relative work of loads that drive a motion
  FreeMotion found;
  const Index n = system_.coordinate_count();
  if (n == 0) return found;
  (void)smallest_eigenpair(found.shape);
  VectorXd motion = VectorXd::Zero(n + system_.constraint_count()), terms(motion.size()), load(n);
  motion.head(n) = found.shape.cwiseAbs();
  matrix_.term_magnitudes(motion, terms);
  KktMatrix::Extended x = KktMatrix::Extended::Zero(motion.size());
  x.head(n) = found.shape.cast<long double>();
  found.exists = matrix_.energy_over_roundoff(x) <= 1;
  system_.load_factor_derivative(state, load);
  const double work = motion.head(n).cwiseQuotient(system_.scale()).norm() *
                      load.cwiseProduct(system_.scale()).norm();
  found.is_driven = std::abs(found.shape.dot(load)) > kDriven * work;
  motion.head(n).cwiseQuotient(system_.scale()).maxCoeff(&found.coordinate);
  found.stiffness = terms[found.coordinate] / motion[found.coordinate];
  return found;
}

NewtonResult Equilibrium::solve(State& state, double load_factor, const LoadControl& control) {
  NewtonResult result;
  const State before = state;
  const Index n = system_.coordinate_count();
  system_.set_load_factor(state, load_factor);
  const auto fail = [&](Status status, std::string message) {
    state = before;
    result.outcome = {status, std::move(message)};
    return result;
  };
  for (int i = 0; i < options_.max_iterations; ++i) {
    if (!factor_if_moved(state, options_.same_state))
      return fail(Status::singular, "the tangent matrix is singular");
    newton_correction(state, step_, result);
    if (control) {
      load_factor_sensitivity(state, load_step_);
      const double change = control(step_, load_step_);
      step_ += change * load_step_;
      system_.set_load_factor(state, state.load + change);
    }
    if (!step_.allFinite()) return fail(Status::singular, "the tangent matrix is singular");
    apply_correction(state, step_);
    const double last = result.correction.back() = weighted_rms_norm(system_, step_.head(n));
    const double displacement = weighted_rms_norm(system_, state.q.head(n));
    if (converged(result.correction, displacement)) return result;
    if (last > 1e6 * (1 + displacement)) break;
  }
  std::ostringstream message;
  message << "Newton's method did not converge at load factor " << load_factor << " in "
          << result.correction.size() << " iterations; last correction relative to the model size "
          << result.correction.back() << ", residual " << result.force_residual.back() << " N m";
  return fail(Status::not_converged, message.str());
}

}  // namespace trammel::solver::large_motion

namespace trammel::solver {

void count_element_evaluations(const large_motion::GeometricallyExactSystem& system,
                               std::int64_t tangents, bool moving, Counters& counters) {
  const Model& model = system.model();
  const auto plates = static_cast<std::int64_t>(model.triangles.size());
  std::int64_t all = plates, stretching = 0, shearing = 0, turning = 0, heavy = 0, spring_ends = 0;
  for (const Member& member : model.members) {
    all += member.elements;
    if (member.section.mass_per_length > 0) heavy += member.elements;
    for (const MemberEnd& end : member.ends) spring_ends += end.fixity == EndFixity::sprung ? 1 : 0;
    if (!(member.section.EI > 0)) continue;
    if (member.axially_flexible) stretching += member.elements;
    if (has_shear_deformation(member.theory)) shearing += member.elements;
    const bool turns = has_rotary_inertia(member.theory) && member.section.inertia_per_length > 0;
    if (turns) turning += member.elements;
  }
  counters.element_evaluations += tangents * all;
  counters.add(Effect::large_displacement, tangents * all);
  counters.add(Effect::geometric_stiffening, tangents * all);
  counters.add(Effect::axial_flexibility, tangents * stretching);
  counters.add(Effect::shear, tangents * shearing);
  counters.add(Effect::joint_compliance, tangents * spring_ends);
  counters.add(Effect::platform_flexibility, tangents * plates);
  if (moving) {
    counters.add(Effect::inertia, tangents);
    counters.add(Effect::rotary_inertia, tangents * turning);
  }
  if (!model.gravity.isZero(0)) counters.add(Effect::gravity, all);
  if (moving || !model.gravity.isZero(0)) counters.add(Effect::link_mass, heavy);
}

StaticSolution solve_large_statics(const Model& model,
                                   const large_motion::LargeMotionModel& large_motion) {
  const large_motion::GeometricallyExactSystem system(model, large_motion);
  large_motion::StaticPathOptions options;
  options.first_step = 0.5;
  options.small_response = 0.01;
  options.keep_points = false;
  const large_motion::StaticPath path = follow_static_path(system, options);
  StaticSolution solution;
  if (path.outcome.solved()) solution = static_solution(system, path.points.back().state);
  solution.outcome = path.outcome;
  solution.evidence = path.evidence;
  solution.counters = path.counters;
  count_element_evaluations(system, path.counters.factorizations, false, solution.counters);
  return solution;
}

StaticSolution estimate_large_statics(const Model& model,
                                      const large_motion::LargeMotionModel& large_motion) {
  // The corrections alternate between bending and the resulting axial forces, so that only every
  // second correction is smaller than the previous one. If the convergence is fast, ten corrections
  // yield six correct digits.
  const large_motion::NewtonOptions options{
      .max_iterations = 12, .tolerance = 1e-6, .same_state = 1e300};  // reuses the first tangent
  const large_motion::GeometricallyExactSystem system(model, large_motion);
  large_motion::Equilibrium equilibrium(system, options);
  large_motion::State state = system.reference_state();
  bool solved = equilibrium.factorize_tangent(state);
  const Index unstable = equilibrium.matrix().unstable_direction_count();
  solved = solved && equilibrium.solve(state, 1).outcome.solved() &&
           equilibrium.factorize_tangent(state);
  if (!solved || equilibrium.matrix().unstable_direction_count() != unstable)
    return solve_large_statics(model, large_motion);
  StaticSolution solution = static_solution(system, state);
  solution.counters.factorizations = equilibrium.matrix().factorizations();
  solution.counters.solves = equilibrium.matrix().solves();
  count_element_evaluations(system, solution.counters.factorizations, false, solution.counters);
  return solution;
}

}  // namespace trammel::solver
