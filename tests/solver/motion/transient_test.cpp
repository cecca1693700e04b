#include "solver/motion/transient.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <functional>

#include "solver/linear/row_balance.h"
#include "solver/motion/modal_superposition.h"
#include "tests/support/solver/allocations.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(transient)

using namespace trammel::solver;
using boost::test_tools::tolerance;
using Eigen::VectorXd;

namespace {

/// Returns a chain of masses between springs, fixed at its first end.
EquationOfMotion chain(Index n, double mass, double stiffness) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    M(i, i) = mass;
    K(i, i) = i + 1 < n ? 2 * stiffness : stiffness;
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -stiffness;
  }
  EquationOfMotion equation;
  equation.M = sparse(M);
  equation.K = sparse(K);
  return equation;
}

/// Returns a load with two patterns. The factors of both patterns are piecewise linear in time and
/// jump at 0.3 s.
PiecewiseLinearLoad load_with_jumps(Index n) {
  PiecewiseLinearLoad load;
  load.pattern = Eigen::MatrixXd::Zero(n, 2);
  load.pattern(n - 1, 0) = 1;
  load.pattern(0, 1) = 1;
  load.time = {0, 0.3, 0.3, 0.71, 1};
  load.factor = (Eigen::MatrixXd(2, 5) << 1, 2, 0, 0.5, 0.5, 0, 0, -1, 3, -2).finished();
  return load;
}

/// Checks that a motion stopped with a reason that contains a text.
void check_stop_reason(const TransientSummary& summary, const std::string& reason) {
  BOOST_TEST((summary.outcome.status == Status::not_converged));
  BOOST_TEST(summary.outcome.reason.find(reason) != std::string::npos, summary.outcome.reason);
}

}  // namespace

// Manufactured solution q = (sin 3t, cos 2t) with time-dependent matrices that have skew parts.
BOOST_AUTO_TEST_CASE(time_schemes_converge_with_their_order) {
  const auto M = [](double t) -> Eigen::Matrix2d {
    return (Eigen::Matrix2d() << 2 + std::sin(t), 0.3, 0.3, 1 + 0.5 * std::cos(t)).finished();
  };
  const auto C = [](double t) -> Eigen::Matrix2d {
    return (Eigen::Matrix2d() << 2 + std::cos(t), 1.5, -1.5, 0.5).finished();
  };
  const auto K = [](double t) -> Eigen::Matrix2d {
    return (Eigen::Matrix2d() << 30 + 5 * t * t, 2 - t, -2 + t, 20).finished();
  };
  const auto q = [](double t) { return Eigen::Vector2d(std::sin(3 * t), std::cos(2 * t)); };
  const auto v = [](double t) {
    return Eigen::Vector2d(3 * std::cos(3 * t), -2 * std::sin(2 * t));
  };
  const auto a = [](double t) {
    return Eigen::Vector2d(-9 * std::sin(3 * t), -4 * std::cos(2 * t));
  };
  EquationOfMotion equation;
  equation.M = sparse(M(0));
  equation.C = sparse(C(0));
  equation.K = sparse(K(0));
  equation.update = [&](double t, SparseMatrix& m, SparseMatrix& c, SparseMatrix& k) {
    Eigen::Map<Eigen::Matrix2d>(m.valuePtr()) = M(t);
    Eigen::Map<Eigen::Matrix2d>(c.valuePtr()) = C(t);
    Eigen::Map<Eigen::Matrix2d>(k.valuePtr()) = K(t);
  };
  equation.load = [&](double t, VectorXd& f) { f = M(t) * a(t) + C(t) * v(t) + K(t) * q(t); };
  TransientOptions options;
  options.end = 2;
  options.q0 = q(0);
  options.v0 = v(0);
  const auto errors = [&](double step) {
    options.step = step;
    const TransientHistory h = solve_transient(equation, options);
    BOOST_TEST(h.summary.outcome.solved(), h.summary.outcome.reason);
    BOOST_TEST(h.summary.largest_residual < 1e-13);
    const Index last = h.q.cols() - 1;
    return Eigen::Array3d((h.q.col(last) - q(2)).norm(), (h.v.col(last) - v(2)).norm(),
                          (h.a.col(last) - a(2)).norm());
  };
  for (const auto& [scheme, order] :
       {std::pair(average_acceleration(), 2), std::pair(linear_acceleration(), 2),
        std::pair(central_difference(), 2), std::pair(hht_alpha(-0.1), 2),
        std::pair(hht_alpha(-1.0 / 3), 2), std::pair(generalized_alpha(0.0), 2),
        std::pair(generalized_alpha(0.6), 2), std::pair(newmark(0.3025, 0.6), 1)}) {
    options.scheme = scheme;
    const Eigen::Array3d coarse = errors(0.004), fine = errors(0.002);
    for (Index i = 0; i < 3; ++i)
      BOOST_TEST(observed_order(coarse[i], fine[i]) == order, tolerance(0.07));
  }
}

BOOST_AUTO_TEST_CASE(error_control_holds_its_tolerance_and_counts_its_steps) {
  EquationOfMotion equation = chain(4, 1, 200);
  const RayleighDamping damping{.mass = 1, .stiffness = 1e-2};
  equation.C = damping_matrix(damping, equation.M, equation.K);
  const PiecewiseLinearLoad load = load_with_jumps(4);
  load.apply_to(equation);
  const ModalBasis basis = all_modes(equation.M, equation.K);
  TransientOptions options = transient_options(1, 0.1);
  options.sample_times = {1};
  const ModalResponse exact = superpose(basis, decay_rates(damping, basis.omega), equation.M, load,
                                        {0, 1}, VectorXd(), VectorXd());
  for (const TimeScheme& scheme : {average_acceleration(), generalized_alpha(0.5)}) {
    options.scheme = scheme;
    double before = 0;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      options.adaptive = ErrorControl{.relative = tolerance};
      const TransientHistory h = solve_transient(equation, options);
      BOOST_TEST(h.summary.outcome.solved(), h.summary.outcome.reason);
      const double error = (h.q.col(0) - exact.q.col(1)).norm() / exact.q.col(1).norm();
      BOOST_TEST(error < 10 * tolerance);
      if (before > 0) BOOST_TEST((before / error > 30 && before / error < 300));
      before = error;
      BOOST_TEST(h.summary.accepted > 0);
      BOOST_TEST(h.summary.rejected > 0);
      BOOST_TEST(h.summary.smallest_step < h.summary.largest_step);
      // A factorization is required for each step size in each segment between breakpoints of the
      // load, not for each change of the step size.
      BOOST_TEST(h.summary.counters.factorizations < 60);
    }
  }
}

BOOST_AUTO_TEST_CASE(unreachable_tolerance_names_the_step) {
  EquationOfMotion equation = chain(2, 1, 100);
  step_load(Eigen::Vector2d(0, 1)).apply_to(equation);
  TransientOptions options = transient_options(1, 0.1);
  options.adaptive = ErrorControl{.relative = 1e-12, .finest_level = 3};
  const TransientHistory h = solve_transient(equation, options);
  check_stop_reason(h.summary, "step 1 at time 0 s of size 0.0125 s");
}

BOOST_AUTO_TEST_CASE(step_beyond_the_stability_limit_is_refused) {
  const EquationOfMotion equation = chain(8, 1, 100);
  const double fastest = all_modes(equation.M, equation.K).omega.maxCoeff();
  TransientOptions options = transient_options(1, 0.95 * 2 / fastest, central_difference());
  options.v0 = VectorXd::Ones(8);
  BOOST_TEST(solve_transient(equation, options).summary.outcome.solved());
  options.step = 1.05 * 2 / fastest;
  const TransientHistory h = solve_transient(equation, options);
  check_stop_reason(h.summary, "use h below");
  BOOST_TEST(h.summary.accepted == 0);
}

BOOST_AUTO_TEST_CASE(load_that_is_not_a_number_ends_the_motion) {
  EquationOfMotion equation = chain(2, 1, 100);
  equation.load = [](double t, VectorXd& f) { f.setConstant(t > 0.52 ? std::nan("") : 1.0); };
  TransientOptions options = transient_options(1, 0.1);
  const TransientHistory h = solve_transient(equation, options);
  check_stop_reason(h.summary, "step 6 at time 0.5 s");
  BOOST_TEST(h.time.size() == 6U);
  BOOST_TEST(h.q.allFinite());
}

BOOST_AUTO_TEST_CASE(step_count_does_not_add_allocations, *boost::unit_test::label("allocations")) {
  EquationOfMotion equation = chain(40, 1, 100);
  equation.C = damping_matrix({.mass = 0.1, .stiffness = 1e-3}, equation.M, equation.K);
  equation.load = [](double t, VectorXd& f) { f.setConstant(std::sin(t)); };
  TransientOptions options;
  options.step = 1e-3;
  double largest = 0;
  const MotionObserver observe = [&largest](const MotionSample& sample) {
    largest = std::max(largest, sample.q.cwiseAbs().maxCoeff());
  };
  const auto cost = [&](double end) {
    options.end = end;
    const std::int64_t before = allocations();
    const TransientSummary summary = solve_transient(equation, options, observe);
    BOOST_TEST(summary.counters.factorizations == 2);  // of the mass matrix and of the step matrix
    return allocations() - before;
  };
  static_cast<void>(cost(0.01));
  const std::int64_t ten = cost(0.01);
  BOOST_TEST(cost(10) == ten);
  if (allocations() > 0) BOOST_TEST(ten > 10);
  BOOST_TEST(largest > 0);
}

BOOST_AUTO_TEST_CASE(quasi_static_start_ignores_a_later_jump) {
  EquationOfMotion equation = chain(1, 1, 100);
  const double jump = 0.003;
  equation.load = [=](double t, VectorXd& f) { f.setConstant(t < jump ? 2 * t : 50.0); };
  equation.breakpoints = {jump};
  TransientOptions options = transient_options(0.02, 0.01);
  options.quasi_static_start = true;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST_REQUIRE(h.summary.outcome.solved());
  BOOST_TEST(h.v(0, 0) == 2 / equation.K.coeff(0, 0), tolerance(1e-10));
}

/// Masses on stiff springs with strong damping follow a slow load without an initial vibration.
BOOST_AUTO_TEST_CASE(quasi_static_start_includes_its_drag) {
  EquationOfMotion equation = chain(3, 1, 1e6);
  equation.C = 0.003 * equation.K;
  const double slow = 0.5;
  equation.load = [=](double t, VectorXd& f) {
    f.setZero();
    f[2] = 10 + std::sin(slow * t);
  };
  TransientOptions options = transient_options(0.1, 0.01);
  options.quasi_static_start = true;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_REQUIRE(h.summary.outcome.solved());
  const double of_the_drag =
      0.003 * slow;  // force in each spring [N], equal to the acceleration of 1 kg [m/s^2]
  BOOST_TEST(h.a.col(0).cwiseAbs().maxCoeff() < 1e-6 * of_the_drag);
  BOOST_TEST(h.q(2, 0) == 3 * (10 - of_the_drag) / 1e6, tolerance(1e-9));
  BOOST_TEST(h.v(2, 0) == 3 * slow / 1e6, tolerance(1e-6));
  equation.K *= 0;
  BOOST_TEST((solve_transient(equation, options).summary.outcome.status == Status::singular));
}

BOOST_AUTO_TEST_CASE(invalid_options_and_equations_are_refused) {
  using Change = std::function<void(EquationOfMotion&, TransientOptions&)>;
  const std::vector<Change> changes = {
      [](auto&, auto& o) { o.step = 0; },
      [](auto&, auto& o) { o.end = -1; },
      [](auto&, auto& o) { o.q0 = VectorXd::Zero(3); },
      [](auto&, auto& o) {
        o.sample_times = std::vector({0.5, 0.2});
      },
      [](auto&, auto& o) {
        o.sample_times = std::vector({0.5, 2.0});
      },
      [](auto&, auto& o) { o.adaptive = ErrorControl{.relative = 0}; },
      [](auto& e, auto&) { e.C = sparse(Eigen::MatrixXd::Ones(3, 3)); },
      [](auto& e, auto&) { e.update = [](double, auto&, auto&, auto&) {}; }};
  for (const Change& change : changes) {
    EquationOfMotion equation = chain(2, 1, 1);
    TransientOptions options = transient_options(1, 0.1);
    change(equation, options);
    BOOST_CHECK_THROW(static_cast<void>(solve_transient(equation, options)), ModelError);
  }
}

BOOST_AUTO_TEST_CASE(decayed_vibration_ends_in_zeros) {
  EquationOfMotion equation = chain(4, 1, 200);
  // The amplitude decreases by a factor of 0.5 per step and underflows to 0 after 1075 steps.
  TransientOptions options = transient_options(40000, 1, generalized_alpha(0.5));
  options.sample_times = {0, 40000};
  options.v0 = VectorXd::Ones(4);
  const TransientHistory found = solve_transient(equation, options);
  BOOST_TEST(found.summary.outcome.solved(), found.summary.outcome.reason);
  BOOST_TEST(found.q.col(1).norm() < 1e-290);
}

BOOST_AUTO_TEST_CASE(peak_of_a_parabola_is_between_samples) {
  const auto parabola = [](double t) { return 3 - 2 * (t - 1.2) * (t - 1.2); };
  const Peak found =
      peak({0.1, 0.9, 1.7}, Eigen::Vector3d(parabola(0.1), parabola(0.9), parabola(1.7)));
  BOOST_TEST(found.time == 1.2, tolerance(1e-12));
  BOOST_TEST(found.value == 3, tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
