#include "solver/statics/second_order.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "solver/assembly/length_scales.h"
#include "solver/assembly/stiffness_factors.h"
#include "solver/assembly/strain.h"
#include "solver/linalg/factorization.h"
#include "solver/linalg/forward_error.h"
#include "solver/linalg/refinement.h"
#include "solver/statics/linear_solution.h"

namespace trammel::solver {
namespace {

using Eigen::VectorXd;

class SecondOrderTheory {
 public:
  SecondOrderTheory(const System& system, const VectorXd& linear, Counters& counters)
      : system_(system),
        linear_(linear),
        counters_(counters),
        lengths_(free_length_scales(system)),
        elastic_(stiffness_operator(system)) {}

  StaticState run() {
    StaticState reached;
    double load = 0;
    double step = 1;
    while (load < 1) {
      const double target = std::min(1.0, load + step);
      StaticState next = load > 0 ? reached : first_order(target);
      iterate(target, next);
      if (next.outcome.solved()) {
        reached = std::move(next);
        load = target;
        step *= 2;
        continue;
      }
      if (load == 0 && step == 1) whole_ = next.outcome;
      step /= step >= 1 ? 8 : 2;
      if (step < kSmallestStep) return failed(load);
    }
    reached.error = error(reached);
    reached.outcome = outcome_by_error(reached.error);
    return reached;
  }

 private:
  static constexpr double kSmallestStep = 1e-4;

  [[nodiscard]] StaticState failed(double load) const {
    std::ostringstream reason;
    reason.precision(4);
    reason << whole_.reason << ": second-order theory has no stable equilibrium beyond " << load
           << " of the loads";
    return {{whole_.status, reason.str()}, {}, {}};
  }

  /// Forces of q under a share of the loads.
  [[nodiscard]] Prestress forces_at(double load, const VectorXd& q, const Prestress* before) const {
    BodyForces weights = body_forces(system_);
    for (Vector2d& weight : weights.element) weight *= load;
    for (Vector2d& weight : weights.point_mass) weight *= load;
    return forces_of(system_, system_.T * q, load * system_.load, weights, before);
  }

  [[nodiscard]] StaticState first_order(double load) const {
    const VectorXd q = load * linear_;
    return {{}, q, forces_at(load, q, nullptr)};
  }

  /// K + K_G of the latest forces until they repeat, from a state nearby.
  void iterate(double load, StaticState& state) {
    constexpr int kIterations = 60;
    const VectorXd f = load * system_.f;
    double last_change = std::numeric_limits<double>::infinity();
    int growing = 0;
    for (int k = 0; k < kIterations && growing < 4; ++k) {
      const VectorXd before = state.q;
      if (!solve(f, state)) return;
      state.forces = forces_at(load, state.q, &state.forces);
      const double size = measure(state.q);
      const double change = measure(state.q - before);
      const double ratio = change / last_change;
      const bool slow = !(ratio < 0.5);
      left_ = size > 0 ? change / size * (ratio < 1 ? ratio / (1 - ratio) : 1) : 0;
      // Forces can change where nothing moves: they are those that were factored from the second
      // on.
      const bool settled =
          change <= 1e-14 * size || (slow && change <= force_rounding(state) + 1e-8 * size);
      if (k > 0 && settled) return;
      growing = change < last_change ? 0 : growing + 1;
      last_change = change;
    }
    state.outcome = {Status::not_converged, "the forces of the state do not settle"};
  }

  /// max |u|, rotations times the size of the model.
  [[nodiscard]] double measure(const VectorXd& q) const {
    return (lengths_ * q).lpNorm<Eigen::Infinity>();
  }

  /// What rounding of the state's forces does to the displacements.
  [[nodiscard]] double force_rounding(const StaticState& state) {
    const VectorXd u = system_.T * state.q;
    const VectorXd change =
        geometric_stiffness_forces(system_, prestress_roundoff(system_, state.q), u);
    ++counters_.solves;
    return measure(factorization_.solve(system_.T.transpose() * change));
  }

  /// StaticState::error of the state that was solved last.
  [[nodiscard]] double error(const StaticState& state) {
    const Operator inverse = [&](const VectorXd& b) -> VectorXd {
      ++counters_.solves;
      return factorization_.solve(b);
    };
    if (state.q.isZero(0)) return 0;
    return forward_error(stiffness_factors(system_), lengths_, state.q, system_.f, inverse) +
           force_rounding(state) / measure(state.q) + left_;
  }

  /// (K + K_G) q = f; false with the outcome where there is no stable solution.
  bool solve(const VectorXd& f, StaticState& state) {
    const SparseMatrix K_G = geometric_stiffness(system_, state.forces);
    const std::size_t elements = system_.mesh.frame.size() + system_.model.triangles.size();
    counters_.count(Effect::geometric_stiffening, static_cast<std::int64_t>(elements));
    factorization_.compute(system_.K + K_G);
    ++counters_.factorizations;
    if (!factorization_.exists() || factorization_.smallest_pivot() <= 0) {
      state.outcome = {Status::singular, "the loads reach or exceed the buckling load"};
      return false;
    }
    const Operator tangent = [&](const VectorXd& q) -> VectorXd { return elastic_(q) + K_G * q; };
    const RefinedSolution refined = refined_solve(tangent, factorization_, f, counters_);
    state.q = refined.x;
    if (refined.converged()) return true;
    state.outcome = {Status::not_converged, "the stiffness of the state is too ill-conditioned"};
    return false;
  }

  const System& system_;
  const VectorXd& linear_;
  Counters& counters_;
  SparseMatrix lengths_;
  Operator elastic_;
  Factorization factorization_;
  Outcome whole_;    // of the first attempt, under the whole load
  double left_ = 0;  // of q, what the latest iteration leaves
};

}  // namespace

Prestress forces_of(const System& system, const VectorXd& u, const VectorXd& load,
                    const BodyForces& body, const Prestress* before) {
  VectorXd force = internal_forces(system, u) - load;
  if (before) force += geometric_stiffness_forces(system, *before, u);
  return prestress(system, u, system.constraints.multipliers(force), body);
}

StaticState solve_second_order(const System& system, const VectorXd& linear, Counters& counters) {
  const Outcome determined = require_determined_stiffening(system);
  if (!determined.solved()) return {determined, {}, {}};
  return SecondOrderTheory(system, linear, counters).run();
}

}  // namespace trammel::solver
