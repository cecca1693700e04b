#include "references/numerics/ball.h"

#include <boost/test/unit_test.hpp>

#include "references/numerics/arguments.h"
#include "references/programs/program.h"

BOOST_AUTO_TEST_SUITE(ball)

using namespace trammel::references;

BOOST_AUTO_TEST_CASE(ball_decides_only_relations_true_for_all_its_numbers) {
  const Ball third = Ball(1) / 3, doubtful = Ball(Real(1) / 3);
  BOOST_TEST((third < Ball(1)));
  BOOST_TEST((Ball(1) > doubtful));
  BOOST_TEST((Ball(0) == Ball(0)));
  BOOST_TEST(!(third - third == Ball(0)));  // the difference is a ball around 0, not exactly 0
  BOOST_CHECK_THROW((void)(third < doubtful), DerivationError);
  BOOST_CHECK_THROW((void)static_cast<int>(third), DerivationError);
  BOOST_TEST(static_cast<int>(ceil(third)) == 1);
  BOOST_CHECK_THROW((void)static_cast<int>(ceil(third * 3)), DerivationError);  // either 1 or 2
}

BOOST_AUTO_TEST_CASE(digits_not_determined_by_a_ball_are_refused) {
  BOOST_TEST(acos(Ball(-1)).digits() == "3.14159265358979323846264338328");
  BOOST_TEST(Ball(Real(3)).digits() == "3.00000000000000000000000000000");
  BOOST_CHECK_THROW((void)(Ball(Real(1) / 3) - Ball(1) / 3).digits(), DerivationError);
}

BOOST_AUTO_TEST_CASE(proved_roots_are_the_published_ones) {
  const auto roots = prove("beam-roots", {{"ends", "pinned-pinned"}, {"count", 2}});
  BOOST_TEST(roots.at(0) == "3.14159265358979323846264338328");
  BOOST_TEST(roots.at(1) == "6.28318530717958647692528676656");
  // The published first root beta L of a cantilever is
  // 1.8751040687119611664453082410782141625701117...
  BOOST_TEST(prove("beam-roots", {{"ends", "clamped-free"}, {"count", 1}}).at(0) ==
             "1.87510406871196116644530824108");
}

BOOST_AUTO_TEST_SUITE_END()
