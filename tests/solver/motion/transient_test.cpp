#include "solver/motion/transient.h"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "solver/linear/row_balance.h"
#include "solver/motion/modal_superposition.h"
#include "tests/support/solver/allocations.h"

BOOST_AUTO_TEST_SUITE(transient)

using namespace trammel::solver;
using Eigen::VectorXd;
using std::numbers::pi;

namespace {

SparseMatrix sparse(const Eigen::MatrixXd& A) {
  SparseMatrix S = A.sparseView();
  S.makeCompressed();
  return S;
}

/// A chain of masses between springs, fixed at its first end.
EquationOfMotion chain(Index n, double mass, double stiffness) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    M(i, i) = mass;
    K(i, i) = i + 1 < n ? 2 * stiffness : stiffness;
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -stiffness;
  }
  return {.M = sparse(M),
          .C = {},
          .K = sparse(K),
          .load = {},
          .update = {},
          .working_motion = {},
          .breakpoints = {}};
}

/// A load of two patterns with slopes that jump and, at 0.3 s, a value that jumps.
PiecewiseLinearLoad rough_load(Index n) {
  PiecewiseLinearLoad load;
  load.pattern = Eigen::MatrixXd::Zero(n, 2);
  load.pattern(n - 1, 0) = 1;
  load.pattern(0, 1) = 1;
  load.time = {0, 0.3, 0.3, 0.71, 1};
  load.factor = (Eigen::MatrixXd(2, 5) << 1, 2, 0, 0.5, 0.5, 0, 0, -1, 3, -2).finished();
  return load;
}

double observed_order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

struct Errors {
  double q, v, a;
};

/// Errors at the end, relative to the exact response, for a step h.
Errors errors_of(const TimeScheme& scheme, double h) {
  EquationOfMotion equation = chain(4, 1, 200);
  const RayleighDamping damping{.mass = 0.4, .stiffness = 2e-3};
  equation.C = damping_matrix(damping, equation.M, equation.K);
  const PiecewiseLinearLoad load = rough_load(4);
  load.apply_to(equation);
  TransientOptions options;
  options.end = 1;
  options.step = h;
  options.scheme = scheme;
  options.sample_times = {1};
  options.v0 = VectorXd::LinSpaced(4, 0.1, -0.2);
  const TransientHistory history = solve_transient(equation, options);
  BOOST_TEST(history.summary.outcome.solved(), history.summary.outcome.reason);
  const ModalBasis basis = all_modes(equation.M, equation.K);
  const ModalResponse exact = superpose(basis, decay_rates(damping, basis.omega), equation.M, load,
                                        {0, 1}, VectorXd(), options.v0);
  return {(history.q.col(0) - exact.q.col(1)).norm() / exact.q.col(1).norm(),
          (history.v.col(0) - exact.v.col(1)).norm() / exact.v.col(1).norm(),
          (history.a.col(0) - exact.a.col(1)).norm() / exact.a.col(1).norm()};
}

double total_energy(const MotionEnergy& e) {
  return e.kinetic + e.strain;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_second_order_scheme_converges_to_the_modal_response_with_order_2) {
  const std::vector<TimeScheme> schemes = {average_acceleration(), linear_acceleration(),
                                           central_difference(),   hht_alpha(-0.1),
                                           hht_alpha(-1.0 / 3),    generalized_alpha(0.0),
                                           generalized_alpha(0.5), generalized_alpha(0.9)};
  for (const TimeScheme& scheme : schemes) {
    const Errors coarse = errors_of(scheme, 2e-3);
    const Errors fine = errors_of(scheme, 1e-3);
    BOOST_TEST(std::abs(observed_order(coarse.q, fine.q, 2) - 2) < 0.1);
    BOOST_TEST(std::abs(observed_order(coarse.v, fine.v, 2) - 2) < 0.1);
    BOOST_TEST(std::abs(observed_order(coarse.a, fine.a, 2) - 2) < 0.1);
    BOOST_TEST(fine.q < 1e-3);
  }
}

BOOST_AUTO_TEST_CASE(newmark_with_numerical_damping_is_of_order_1) {
  const Errors coarse = errors_of(newmark(0.3025, 0.6), 1e-3);
  const Errors fine = errors_of(newmark(0.3025, 0.6), 5e-4);
  BOOST_TEST(std::abs(observed_order(coarse.q, fine.q, 2) - 1) < 0.1);
}

// M = 2 + sin t, C = cos t + 2, K = 30 + 5 t^2 (and a skew part), q = (sin 3t, cos 2t) made up.
BOOST_AUTO_TEST_CASE(changing_and_skew_matrices_keep_order_2) {
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
  for (const TimeScheme& scheme :
       {average_acceleration(), hht_alpha(-0.2), generalized_alpha(0.0), generalized_alpha(0.6)}) {
    options.scheme = scheme;
    std::array<Errors, 2> error{};
    for (std::size_t i = 0; i < 2; ++i) {
      options.step = i == 0 ? 0.004 : 0.002;
      const TransientHistory h = solve_transient(equation, options);
      BOOST_TEST(h.summary.outcome.solved(), h.summary.outcome.reason);
      BOOST_TEST(h.summary.largest_residual < 1e-13);
      const Index last = h.q.cols() - 1;
      error[i] = {(h.q.col(last) - q(2)).norm(), (h.v.col(last) - v(2)).norm(),
                  (h.a.col(last) - a(2)).norm()};
    }
    BOOST_TEST(std::abs(observed_order(error[0].q, error[1].q, 2) - 2) < 0.1);
    BOOST_TEST(std::abs(observed_order(error[0].v, error[1].v, 2) - 2) < 0.1);
    BOOST_TEST(std::abs(observed_order(error[0].a, error[1].a, 2) - 2) < 0.1);
  }
}

BOOST_AUTO_TEST_CASE(schemes_without_dissipation_keep_the_energy_of_a_free_motion) {
  const EquationOfMotion equation = chain(6, 1, 400);
  TransientOptions options;
  options.end = 50;
  options.step = 0.02;
  options.v0 = VectorXd::LinSpaced(6, 1, -2);
  for (const TimeScheme& scheme : {average_acceleration(), hht_alpha(0), generalized_alpha(1)}) {
    options.scheme = scheme;
    const TransientHistory h = solve_transient(equation, options);
    const double begin = total_energy(h.energy.front());
    double worst = 0;
    for (const MotionEnergy& e : h.energy) {
      worst = std::max(worst, std::abs(total_energy(e) / begin - 1));
    }
    BOOST_TEST(worst < 1e-12);
  }
}

BOOST_AUTO_TEST_CASE(work_feeds_what_is_stored_and_what_is_dissipated) {
  EquationOfMotion equation = chain(5, 1, 300);
  equation.C = damping_matrix({.mass = 0.5, .stiffness = 1e-2}, equation.M, equation.K);
  rough_load(5).apply_to(equation);
  TransientOptions options;
  options.end = 1;
  options.step = 0.01;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST(h.energy.back().work > 0);
  BOOST_TEST(h.energy.back().dissipated > 0.1 * h.energy.back().work);
  BOOST_TEST(std::abs(h.energy.back().total() - h.energy.front().total()) <
             1e-13 * h.energy.back().work);
}

BOOST_AUTO_TEST_CASE(numerical_dissipation_removes_fast_motions_and_leaves_slow_ones) {
  // two oscillators, one far faster than the step
  EquationOfMotion equation = chain(2, 1, 1);
  equation.M = sparse(Eigen::Vector2d(1, 1).asDiagonal());
  equation.K = sparse(Eigen::Vector2d(1, 1e8).asDiagonal());
  TransientOptions options;
  options.end = 2 * pi;
  options.step = 2 * pi / 200;
  options.scheme = generalized_alpha(0.5);
  options.q0 = Eigen::Vector2d(1, 1);
  const TransientHistory h = solve_transient(equation, options);
  const Index last = h.q.cols() - 1;
  BOOST_TEST(std::abs(h.q(0, last) - 1) < 2e-4);
  BOOST_TEST(std::abs(h.q(1, last)) < 1e-40);
}

BOOST_AUTO_TEST_CASE(a_free_body_keeps_its_velocity) {
  EquationOfMotion equation = chain(3, 2, 100);
  equation.K =
      sparse((Eigen::Matrix3d() << 100, -100, 0, -100, 200, -100, 0, -100, 100).finished());
  TransientOptions options;
  options.end = 10;
  options.step = 0.1;
  options.scheme = generalized_alpha(0.8);
  options.v0 = Eigen::Vector3d::Constant(3);
  const TransientHistory h = solve_transient(equation, options);
  const Index last = h.q.cols() - 1;
  BOOST_TEST((h.q.col(last) - Eigen::Vector3d::Constant(30)).norm() < 1e-12);
}

BOOST_AUTO_TEST_CASE(error_control_holds_its_tolerance_and_counts_its_steps) {
  EquationOfMotion equation = chain(4, 1, 200);
  const RayleighDamping damping{.mass = 1, .stiffness = 1e-2};
  equation.C = damping_matrix(damping, equation.M, equation.K);
  const PiecewiseLinearLoad load = rough_load(4);
  load.apply_to(equation);
  const ModalBasis basis = all_modes(equation.M, equation.K);
  TransientOptions options;
  options.end = 1;
  options.step = 0.1;
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
      // a factorization for each size of step in each segment, not for each change of step
      BOOST_TEST(h.summary.counters.factorizations < 60);
    }
  }
}

BOOST_AUTO_TEST_CASE(a_tolerance_out_of_reach_is_a_status_that_names_the_step) {
  EquationOfMotion equation = chain(2, 1, 100);
  step_load(Eigen::Vector2d(0, 1)).apply_to(equation);
  TransientOptions options;
  options.end = 1;
  options.step = 0.1;
  options.adaptive = ErrorControl{.relative = 1e-12, .finest_level = 3};
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST((h.summary.outcome.status == Status::not_converged));
  BOOST_TEST(
      h.summary.outcome.reason.find("step 1 at time 0 s of size 0.0125 s") != std::string::npos,
      h.summary.outcome.reason);
}

BOOST_AUTO_TEST_CASE(a_step_beyond_the_stability_limit_is_refused_before_it_is_taken) {
  const EquationOfMotion equation = chain(8, 1, 100);
  const double fastest = all_modes(equation.M, equation.K).omega.maxCoeff();
  TransientOptions options;
  options.end = 1;
  options.scheme = central_difference();
  options.v0 = VectorXd::Ones(8);
  options.step = 0.95 * 2 / fastest;
  BOOST_TEST(solve_transient(equation, options).summary.outcome.solved());
  options.step = 1.05 * 2 / fastest;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST((h.summary.outcome.status == Status::not_converged));
  BOOST_TEST(h.summary.outcome.reason.find("take h below") != std::string::npos);
  BOOST_TEST(h.summary.accepted == 0);
}

BOOST_AUTO_TEST_CASE(a_load_that_is_not_a_number_ends_the_motion_and_says_where) {
  EquationOfMotion equation = chain(2, 1, 100);
  equation.load = [](double t, VectorXd& f) { f.setConstant(t > 0.52 ? std::nan("") : 1.0); };
  TransientOptions options;
  options.end = 1;
  options.step = 0.1;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST((h.summary.outcome.status == Status::not_converged));
  BOOST_TEST(h.summary.outcome.reason.find("step 6 at time 0.5 s") != std::string::npos,
             h.summary.outcome.reason);
  BOOST_TEST(h.time.size() == 6U);
  BOOST_TEST(h.q.allFinite());
}

BOOST_AUTO_TEST_CASE(ten_thousand_steps_allocate_no_more_than_ten,
                     *boost::unit_test::label("allocations")) {
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
    BOOST_TEST(summary.counters.factorizations == 2);  // the mass and the step
    return allocations() - before;
  };
  static_cast<void>(cost(0.01));
  const std::int64_t ten = cost(0.01);
  BOOST_TEST(cost(10) == ten);
  if (allocations() > 0) BOOST_TEST(ten > 10);
  BOOST_TEST(largest > 0);
}

BOOST_AUTO_TEST_CASE(coordinates_without_mass_follow_statically) {
  // mass - spring - massless point - spring - ground: the two springs in series
  EquationOfMotion equation = chain(2, 1, 100);
  equation.M = sparse(Eigen::Vector2d(0, 1).asDiagonal());
  TransientOptions options;
  options.end = 1;
  options.step = 1e-3;
  options.v0 = Eigen::Vector2d(0.5, 1);
  options.sample_times = {1};
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST(h.summary.outcome.solved(), h.summary.outcome.reason);
  const double w = std::sqrt(50.0);
  BOOST_TEST(std::abs(h.q(1, 0) - std::sin(w) / w) < 1e-5);
  BOOST_TEST(std::abs(h.q(0, 0) - 0.5 * h.q(1, 0)) < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_slow_load_from_the_quasi_static_state_stays_quasi_static) {
  EquationOfMotion equation = chain(3, 1, 1000);
  const double slow = 0.5;
  equation.load = [=](double t, VectorXd& f) {
    f.setZero();
    f[2] = 10 + std::sin(slow * t);
  };
  TransientOptions options;
  options.end = 4;
  options.step = 0.01;
  options.quasi_static_start = true;
  const TransientHistory h = solve_transient(equation, options);
  double worst = 0;
  for (std::size_t i = 0; i < h.time.size(); ++i) {
    const double force = 10 + std::sin(slow * h.time[i]);
    for (Index k = 0; k < 3; ++k) {
      const double expected = force * static_cast<double>(k + 1) / 1000;
      worst = std::max(worst, std::abs(h.q(k, static_cast<Index>(i)) - expected));
    }
  }
  // what is left is the inertia of the quasi-static motion: of order slow^2 / w1^2 = 1.3e-3
  BOOST_TEST(worst < 3e-3 * 3 / 1000);
  BOOST_TEST(h.v(2, 0) == 3 * slow / 1000, boost::test_tools::tolerance(1e-6));
  equation.K *= 0;
  BOOST_TEST((solve_transient(equation, options).summary.outcome.status == Status::singular));
}

/// Stiff and strongly damped masses on the way of a slow load: nothing is shaken at the start.
BOOST_AUTO_TEST_CASE(a_quasi_static_start_does_not_look_past_a_jump_of_the_load) {
  EquationOfMotion equation = chain(1, 1, 100);
  const double jump = 0.003;
  equation.load = [=](double t, VectorXd& f) { f.setConstant(t < jump ? 2 * t : 50.0); };
  equation.breakpoints = {jump};
  TransientOptions options;
  options.quasi_static_start = true;
  options.step = 0.01;
  options.end = 0.02;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST_REQUIRE(h.summary.outcome.solved());
  BOOST_TEST(h.v(0, 0) == 2 / equation.K.coeff(0, 0), boost::test_tools::tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(a_quasi_static_start_carries_the_drag_of_its_own_velocity) {
  EquationOfMotion equation = chain(3, 1, 1e6);
  equation.C = 0.003 * equation.K;
  const double slow = 0.5;
  equation.load = [=](double t, VectorXd& f) {
    f.setZero();
    f[2] = 10 + std::sin(slow * t);
  };
  TransientOptions options;
  options.end = 0.1;
  options.step = 0.01;
  options.quasi_static_start = true;
  const TransientHistory h = solve_transient(equation, options);
  BOOST_REQUIRE(h.summary.outcome.solved());
  const double of_the_drag =
      0.003 * slow;  // [N], in each spring; on 1 kg it would be as many m/s^2
  BOOST_TEST(h.a.col(0).cwiseAbs().maxCoeff() < 1e-6 * of_the_drag);
  const double lag = 3 * (10 - of_the_drag) / 1e6;
  BOOST_TEST(h.q(2, 0) == lag, boost::test_tools::tolerance(1e-9));
}

BOOST_AUTO_TEST_CASE(samples_between_steps_are_as_accurate_as_the_steps) {
  const EquationOfMotion equation = chain(1, 1, 100);
  TransientOptions options;
  options.end = 1;
  options.step = 1e-3;
  options.v0 = Eigen::VectorXd::Ones(1);
  options.sample_times = {0, 0, 0.1234567, 0.777, 1};
  const TransientHistory h = solve_transient(equation, options);
  BOOST_TEST(h.time.size() == 5U);
  for (std::size_t i = 0; i < h.time.size(); ++i) {
    const double t = h.time[i];
    BOOST_TEST(t == options.sample_times[i]);
    const auto k = static_cast<Index>(i);
    BOOST_TEST(std::abs(h.q(0, k) - std::sin(10 * t) / 10) < 1e-5);
    BOOST_TEST(std::abs(h.v(0, k) - std::cos(10 * t)) < 1e-4);
    BOOST_TEST(std::abs(h.a(0, k) + 10 * std::sin(10 * t)) < 1e-3);
  }
}

// ANSYS VM74: m = 0.5, k = 200, an impulse of 10 as 4000 for 0.0025 s.
BOOST_AUTO_TEST_CASE(an_impulse_moves_the_oscillator_of_vm74) {
  for (const double c : {0.0, 14.0}) {
    EquationOfMotion equation = chain(1, 0.5, 200);
    equation.C = sparse(Eigen::MatrixXd::Constant(1, 1, c));
    PiecewiseLinearLoad load;
    load.pattern = Eigen::MatrixXd::Ones(1, 1);
    load.time = {0, 0, 0.0025, 0.0025};
    load.factor = (Eigen::MatrixXd(1, 4) << 0, 4000, 4000, 0).finished();
    load.apply_to(equation);
    TransientOptions options;
    options.end = 0.1;
    options.step = 1e-4;
    options.sample_times = {0.08, 0.1};
    const TransientHistory h = solve_transient(equation, options);
    // the pulse of finite length against the ideal impulse of the target: w dt / 2 = 2.5 %
    if (c == 0) {
      BOOST_TEST(std::abs(h.q(0, 0) / 0.99957 - 1) < 2e-3);
      BOOST_TEST(std::abs(h.q(0, 1) / 0.90930 - 1) < 2e-2);
    } else {
      BOOST_TEST(std::abs(h.q(0, 1) / 0.34180 - 1) < 6e-2);
    }
  }
}

// ANSYS VM75: the same under a step of 200.
BOOST_AUTO_TEST_CASE(a_step_load_moves_the_oscillator_of_vm75) {
  for (const double c : {0.0, 10.0}) {
    EquationOfMotion equation = chain(1, 0.5, 200);
    equation.C = sparse(Eigen::MatrixXd::Constant(1, 1, c));
    step_load(VectorXd::Constant(1, 200)).apply_to(equation);
    TransientOptions options;
    options.end = 0.2;
    options.step = 2e-4;
    const TransientHistory h = solve_transient(equation, options);
    const double end = h.q(0, h.q.cols() - 1);
    if (c == 0) {
      const Peak largest = peak(h.time, h.q.row(0));
      BOOST_TEST(std::abs(largest.value - 2) < 1e-5);
      BOOST_TEST(std::abs(largest.time - 0.1575) < 5e-4);
      BOOST_TEST(std::abs(end - 1.6536) < 5e-5);
    } else {
      BOOST_TEST(std::abs(end - 1.1531) < 5e-5);
    }
  }
}

BOOST_AUTO_TEST_CASE(input_without_meaning_is_refused) {
  const EquationOfMotion good = chain(2, 1, 1);
  TransientOptions options;
  options.end = 1;
  options.step = 0.1;
  const auto refused = [&good](const TransientOptions& o) {
    BOOST_CHECK_THROW(static_cast<void>(solve_transient(good, o)), ModelError);
  };
  TransientOptions bad = options;
  bad.step = 0;
  refused(bad);
  bad = options;
  bad.end = -1;
  refused(bad);
  bad = options;
  bad.q0 = VectorXd::Zero(3);
  refused(bad);
  bad = options;
  bad.sample_times = {0.5, 0.2};
  refused(bad);
  bad.sample_times = {0.5, 2};
  refused(bad);
  bad = options;
  bad.adaptive = ErrorControl{.relative = 0};
  refused(bad);
  EquationOfMotion odd = good;
  odd.C = sparse(Eigen::MatrixXd::Ones(3, 3));
  BOOST_CHECK_THROW(static_cast<void>(solve_transient(odd, options)), ModelError);
  odd = good;
  odd.update = [](double, SparseMatrix&, SparseMatrix&, SparseMatrix&) {};
  BOOST_CHECK_THROW(static_cast<void>(solve_transient(odd, options)), ModelError);
}

BOOST_AUTO_TEST_CASE(a_vibration_that_dies_out_ends_in_zeros_and_not_in_a_failure) {
  EquationOfMotion equation = chain(4, 1, 200);
  TransientOptions options;
  options.end = 40000;
  options.step = 1;  // a radius of 0.5 a step: nothing that a double holds after 1075 steps
  options.scheme = generalized_alpha(0.5);
  options.v0 = VectorXd::Ones(4);
  options.sample_times = {0, 40000};
  const TransientHistory found = solve_transient(equation, options);
  BOOST_TEST(found.summary.outcome.solved(), found.summary.outcome.reason);
  BOOST_TEST(found.q.col(1).norm() < 1e-290);
}

BOOST_AUTO_TEST_CASE(the_peak_of_a_parabola_is_found_between_samples) {
  const auto parabola = [](double t) { return 3 - 2 * (t - 1.2) * (t - 1.2); };
  const Peak found =
      peak({0.1, 0.9, 1.7}, Eigen::Vector3d(parabola(0.1), parabola(0.9), parabola(1.7)));
  BOOST_TEST(found.time == 1.2, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(found.value == 3, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_SUITE_END()
