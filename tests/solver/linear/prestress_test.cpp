#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/linear/buckling.h"
#include "solver/linear/modes.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(prestress)

using namespace trammel::solver;
using namespace trammel::testing;
using boost::test_tools::tolerance;

namespace {

/// Returns a unit column, clamped at the origin at an angle [rad], compressed by 1 N at its top.
Model column(Index elements, double angle) {
  Model model = cantilever(unit_section(1e6), 1, elements, angle);
  model.loads = {{1, {-std::cos(angle), -std::sin(angle), 0}}};
  return model;
}

double first_buckling_factor(const Model& model, EigenMethod path = EigenMethod::automatic) {
  const BucklingSolution b = solve_buckling(assemble(model), {1, path});
  BOOST_REQUIRE(b.outcome.solved());
  BOOST_REQUIRE(b.load_factor.size() == 1);
  return b.load_factor[0];
}

}  // namespace

BOOST_AUTO_TEST_CASE(dense_and_sparse_buckling_factors_are_equal) {
  const System system = assemble(column(40, 0.3));
  const BucklingSolution dense = solve_buckling(system, {4, EigenMethod::dense});
  const BucklingSolution sparse = solve_buckling(system, {4, EigenMethod::sparse});
  BOOST_REQUIRE(dense.load_factor.size() == 4);
  BOOST_REQUIRE(sparse.load_factor.size() == 4);
  for (Index i = 0; i < 4; ++i)
    BOOST_TEST(sparse.load_factor[i] == dense.load_factor[i], tolerance(1e-10));
}

BOOST_AUTO_TEST_CASE(tension_does_not_buckle) {
  Model model = column(8, 0.3);
  model.loads[0].force *= -1;
  const BucklingSolution b = solve_buckling(assemble(model), {3, EigenMethod::automatic});
  BOOST_TEST(b.outcome.solved());
  BOOST_TEST(b.load_factor.size() == 0);
}

BOOST_AUTO_TEST_CASE(inextensible_column_buckles_as_a_stiff_one) {
  Model model = column(8, 0.3);
  const double stiff = first_buckling_factor(model);
  model.members[0].axially_flexible = false;
  BOOST_TEST(first_buckling_factor(model) == stiff, tolerance(1e-5));
}

BOOST_AUTO_TEST_CASE(modes_beyond_the_buckling_load_are_refused) {
  Model model = column(8, 0.3);
  model.loads[0].force *= 3;  // 3 N, above the buckling load pi^2 / 4 = 2.47 N
  const ModalSolution r = solve_prestressed_modes(assemble(model), {3, EigenMethod::dense});
  BOOST_TEST((r.outcome.status == Status::singular));
  BOOST_TEST(r.outcome.reason.starts_with("the loads reach or exceed the buckling load"));
  BOOST_TEST(r.frequency.size() == 0);
}

BOOST_AUTO_TEST_SUITE_END()
