#include "solver/motion/motion_evidence.h"

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/model/numbers.h"
#include "solver/motion/transient.h"
#include "tests/support/solver/numerics.h"

BOOST_AUTO_TEST_SUITE(motion_evidence)

using namespace trammel::solver;
using Eigen::VectorXd;

namespace {

SparseMatrix scalar(double value) {
  SparseMatrix A(1, 1);
  A.insert(0, 0) = value;
  A.makeCompressed();
  return A;
}

/// Returns a damped oscillator of 10 rad/s under an oscillating load.
EquationOfMotion oscillator() {
  EquationOfMotion equation;
  equation.M = scalar(2), equation.C = scalar(1), equation.K = scalar(200);
  equation.load = [](double t, VectorXd& f) { f[0] = 3 + 5 * std::sin(7 * t); };
  return equation;
}

TransientHistory run(const EquationOfMotion& equation, const TimeScheme& scheme = {}) {
  TransientOptions options = transient_options(2, 0.02, scheme);
  options.v0 = VectorXd::Constant(1, 0.3);
  return solve_transient(equation, options);
}

/// Returns true for the first evaluation at an instant. The integrator evaluates each instant
/// before the residuals are evaluated.
struct AskedFirst {
  double last = kNaN;
  bool operator()(double time) {
    const bool first = time != last;
    last = time;
    return first;
  }
};

/// Returns an oscillator whose matrices are correct in the residuals, but changed by `spoil` in the
/// time integration.
template <class Spoil>
EquationOfMotion faulty_equation(const Spoil& spoil) {
  EquationOfMotion equation = oscillator();
  equation.update = [spoil, first = AskedFirst{}](double t, SparseMatrix& M, SparseMatrix& C,
                                                  SparseMatrix& K) mutable {
    M = scalar(2), C = scalar(1), K = scalar(200);
    if (first(t)) spoil(M, C, K);
  };
  return equation;
}

}  // namespace

BOOST_AUTO_TEST_CASE(energy_residual_of_every_scheme_is_round_off) {
  for (const TimeScheme& scheme :
       {average_acceleration(), linear_acceleration(), central_difference(), newmark(0.3025, 0.6),
        hht_alpha(-0.3), generalized_alpha(1), generalized_alpha(0.5), generalized_alpha(0)}) {
    const TransientHistory h = run(oscillator(), scheme);
    BOOST_TEST_REQUIRE(h.summary.outcome.solved(), h.summary.outcome.reason);
    BOOST_TEST(h.summary.evidence.largest(Residual::energy) < 1e-13);
    BOOST_TEST(h.summary.evidence.largest(Residual::equation_of_motion) < 1e-14);
    // The energy residual belongs to the discrete energy balance of the scheme. The change of
    // mechanical energy also contains the error of the time integration.
    const double off = std::abs(h.energy.back().total() - h.energy.front().total());
    if (spectral_radius(scheme, 100) < 0.9) BOOST_TEST(off > 1e-6);
  }
}

BOOST_AUTO_TEST_CASE(load_that_changes_between_two_calls_is_refused) {
  EquationOfMotion equation = oscillator();
  equation.load = [first = AskedFirst{}](double t, VectorXd& f) mutable {
    f[0] = 3 + 5 * std::sin(7 * (first(t) ? t - 0.02 : t));
  };
  const Outcome outcome = run(equation).summary.outcome;
  BOOST_TEST(!outcome.solved());
  BOOST_TEST(outcome.reason.find("equation of motion") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(wrong_matrices_are_refused) {
  const auto right = faulty_equation([](auto&, auto&, auto&) {});
  BOOST_TEST(run(right).summary.outcome.solved());
  const auto damping = faulty_equation([](auto&, SparseMatrix& C, auto&) { C = -1 * C; });
  BOOST_TEST(!run(damping).summary.outcome.solved());
  const auto inertia = faulty_equation([](SparseMatrix& M, auto&, auto&) { M = scalar(1.9); });
  BOOST_TEST(!run(inertia).summary.outcome.solved());
  const auto stiffness =
      faulty_equation([](auto&, auto&, SparseMatrix& K) { K = scalar(200 * (1 + 1e-3)); });
  BOOST_TEST(!run(stiffness).summary.outcome.solved());
}

/// Makes one step of the free undamped oscillator by average acceleration, with the coefficient
/// gamma of the new acceleration in the velocity.
BOOST_AUTO_TEST_CASE(wrong_newmark_coefficient_is_refused) {
  EquationOfMotion equation;
  equation.M = scalar(1), equation.K = scalar(100);
  for (const double gamma : {0.5, 0.6}) {
    const double h = 0.02;
    TransientState from(1), to(1);
    from.q[0] = 1, from.v[0] = 2, from.A[0] = from.a[0] = -100;
    const double predicted = from.q[0] + h * from.v[0] + h * h / 4 * from.a[0];
    to.A[0] = to.a[0] = -100 * predicted / (1 + 100 * h * h / 4);
    to.q[0] = predicted + h * h / 4 * to.a[0];
    to.v[0] = from.v[0] + h * ((1 - gamma) * from.a[0] + gamma * to.a[0]);
    for (TransientState* s : {&from, &to}) {
      s->Ma = s->a, s->Mv = s->v, s->Kq = 100 * s->q;
      s->energy.kinetic = s->v.dot(s->v) / 2;
      s->energy.strain = 50 * s->q.dot(s->q);
    }
    MotionEvidence evidence(equation);
    evidence.add_equilibrium(h, h, to.q, to.v, to.a, h);
    evidence.add_energy_balance(from, to, h);
    BOOST_TEST(outcome_by_evidence({}, evidence.result()).solved() == (gamma == 0.5));
    evidence.add_scheme_residual(from, to, h);
    BOOST_TEST(outcome_by_evidence({}, evidence.result()).solved() == (gamma == 0.5));
  }
}

BOOST_AUTO_TEST_SUITE_END()
