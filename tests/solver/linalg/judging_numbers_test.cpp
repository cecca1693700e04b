#include <boost/test/unit_test.hpp>
#include <cmath>

#include "solver/linalg/dense_eigen.h"
#include "solver/linear/element_operators.h"
#include "solver/model/numbers.h"
#include "tests/support/solver/frames.h"

BOOST_AUTO_TEST_SUITE(judging_numbers)

using namespace trammel::solver;
using namespace trammel::testing;

BOOST_AUTO_TEST_CASE(residual_without_number_or_terms_is_infinite) {
  const Eigen::Vector2d ones(1, 1);
  BOOST_TEST(row_backward_error(Eigen::Vector2d(0, 3), Eigen::Vector2d(0, 6)) == 0.5);
  BOOST_TEST(row_backward_error(Eigen::Vector2d(3, 0), Eigen::Vector2d(6, 1)) == 0.5);
  for (const auto& [residual, terms] :
       {std::pair(Eigen::Vector2d(0, kNaN), ones), std::pair(ones, Eigen::Vector2d(kNaN, 1)),
        std::pair(Eigen::Vector2d(0, 1), Eigen::Vector2d(1, 0)),
        std::pair(Eigen::Vector2d(0, 1), Eigen::Vector2d(kNaN, 1))})
    BOOST_TEST(std::isinf(row_backward_error(residual, terms)));
}

BOOST_AUTO_TEST_CASE(dependent_column_has_a_pivot_of_zero) {
  const Eigen::Matrix3d A{{1, 2, 3}, {0, 4, 4}, {2, -1, 1}};
  BOOST_TEST(pivoted_solve(A, Eigen::Vector3d::Ones()).smallest_to_largest_pivot < 1e-15);
  const PivotedSolution found =
      pivoted_solve(Eigen::Vector3d(4, 8, 1).asDiagonal(), Eigen::Vector3d(4, 16, 3));
  BOOST_TEST(found.smallest_to_largest_pivot == 0.125);
  BOOST_TEST(found.x == Eigen::Vector3d(1, 2, 3));
}

// The exact strain of a bar within a rigid body is zero, but the rounded motion of the body causes
// a nonzero computed strain.
BOOST_AUTO_TEST_CASE(magnitude_of_canceling_strain_terms_is_kept) {
  Model model;
  model.nodes = {{"A", {0, 0}}, {"B", {3, 4}}};
  model.rigid_bodies = {{"body", 0, {1}}};
  model.members = {hinged("AB", 0, 1, unit_section())};
  const FactoredStiffness K = factor_stiffness(assemble(model));
  BOOST_TEST(Eigen::MatrixXd(K.A).row(0).lpNorm<Eigen::Infinity>() < 1e-15);
  // A translation (x, y) moves both ends along the bar by 0.6 x + 0.8 y. A unit rotation moves B by
  // (-4, 3). `size` contains the sums of the absolute terms that cancel in the strain.
  const Eigen::RowVector3d terms = Eigen::RowVector3d(2 * 0.6, 2 * 0.8, 0.6 * 4 + 0.8 * 3);
  const Eigen::MatrixXd size = K.size;
  BOOST_TEST((size.row(0).head<3>() - terms).lpNorm<Eigen::Infinity>() < 1e-14);
}

BOOST_AUTO_TEST_SUITE_END()
